"""Runs inside Blender, with a scene of blender_import.py: prints what is where as JSON, and what a user gets by hand.

    blender -b FILE.blend -P inspect_blender.py -- FRAME OUT.json PC2_FOLDER BODY"""
import json
import sys

import bpy

frame, output, folder, body = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene


def points(thing):
    """Of the vertices in the world, with all modifiers."""
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [list(thing.matrix_world @ v.co) for v in shown.to_mesh().vertices]


def describe(thing):
    mesh = thing.data
    return {"points": points(thing), "faces": [list(p.vertices) for p in mesh.polygons], "materials": [m.name for m in mesh.materials],
            "colour": list(mesh.materials[0].diffuse_color), "uvs": [list(d.uv) for layer in mesh.uv_layers for d in layer.data]}


def by_hand():
    """The object of an OBJ file that is imported as it comes, with the modifier's own axes."""
    bpy.ops.wm.obj_import(filepath=f"{folder}/{body}.obj")
    thing, = bpy.context.selected_objects
    cache = thing.modifiers.new("motion", "MESH_CACHE")
    cache.cache_format, cache.filepath, cache.frame_start = "PC2", f"{folder}/{body}.pc2", 0
    scene.frame_set(int(frame))
    return points(thing)


scene.frame_set(int(frame))
found = {"meshes": {thing.name: describe(thing) for thing in scene.objects if thing.type == "MESH"},
         "range": [scene.frame_start, scene.frame_end], "rate": scene.render.fps / scene.render.fps_base, "by_hand": by_hand()}
with open(output, "w", encoding="utf-8") as file:
    json.dump(found, file)
