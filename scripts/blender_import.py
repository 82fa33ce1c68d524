"""Builds the scene of a run in Blender: bodies with their motion, obstacles, materials, frame rate (docs/hand-over.md).

    blender -P scripts/blender_import.py -- OUT_FOLDER [options]
    blender -b -P scripts/blender_import.py -- OUT_FOLDER --save toy.blend --render toy.png --frame 30

OUT_FOLDER is that of bemsim --format pc2. Frame k of the run is frame k of Blender. Needs nothing but Blender."""
import argparse
import json
import math
import pathlib
import struct
import sys

import bpy
import numpy as np
from bpy_extras.io_utils import axis_conversion
from mathutils import Quaternion, Vector

COLOURS = ["ff7d6b", "2fb5a6", "f6b13d", "8a7df0", "4a9cee", "ec74aa", "74bf60", "c98d62"]  # of bodies, as in bemview
GREY = "b9b9b4"  # of obstacles
CREASE = math.radians(50)


def parse_arguments():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="blender [-b] -P scripts/blender_import.py --", description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path, metavar="OUT_FOLDER", help="folder of a run with the format pc2")
    parser.add_argument("--save", type=pathlib.Path, metavar="FILE.blend", help="save the scene")
    parser.add_argument("--render", type=pathlib.Path, metavar="PNG", help="render a picture with Cycles")
    parser.add_argument("--frame", type=int, help="frame to render (the middle one)")
    parser.add_argument("--samples", type=int, default=48, help="samples of a pixel (48)")
    parser.add_argument("--width", type=int, default=1280, help="pixels (1280), 16 by 9")
    return parser.parse_args(words)


class Run:
    """What bemsim has written into OUT_FOLDER/pc2."""

    def __init__(self, folder):
        self.folder = folder / "pc2" if (folder / "pc2").is_dir() else folder
        notes = self.folder / "scene.jsonl"
        if not notes.exists():
            raise SystemExit(f"error: {notes}: there is no such file; run bemsim with --format pc2")
        first, *frames = map(json.loads, notes.read_text(encoding="utf-8").splitlines())
        self.up, self.bodies, self.obstacles = first["up"], first["bodies"], first["obstacles"]
        self.times = [frame["time"] for frame in frames]
        self.places = [frame["places"] for frame in frames]
        axis = max(range(3), key=lambda i: abs(self.up[i]))
        sign = "" if self.up[axis] > 0 else "-"
        self.turn = axis_conversion("-Z" if axis == 1 else "Y", sign + "XYZ"[axis], "Y", "Z")  # to the axes of Blender

    def cache(self, body):
        return self.folder / f"{body}.pc2"

    def samples(self, body):
        """[frames, vertices, 3], in the axes of the run."""
        data = self.cache(body).read_bytes()
        vertices, = struct.unpack_from("<i", data, 16)
        count, = struct.unpack_from("<i", data, 28)
        return np.frombuffer(data, "<f4", 3 * vertices * count, 32).reshape(count, vertices, 3)

    def bounds(self):
        """Least and greatest coordinates of all bodies in all frames, in Blender's axes."""
        ends = np.concatenate([[x.min((0, 1)), x.max((0, 1))] for x in map(self.samples, self.bodies)]) @ np.array(self.turn).T
        return ends.min(0), ends.max(0)

    def rate(self):
        return (len(self.times) - 1) / (self.times[-1] - self.times[0]) if len(self.times) > 1 else 24.0


class Obj:
    """An OBJ file: all vertices in their order, and faces with texture coordinates and materials."""

    def __init__(self, path):
        self.vertices, self.uvs, self.faces, self.face_uvs, self.face_materials = [], [], [], [], []
        self.materials, self.libraries, current = [], [], 0
        for line in path.read_text(encoding="utf-8", errors="replace").replace("\\\n", " ").splitlines():
            word, _, rest = line.strip().partition(" ")
            if word in ("v", "vt"):
                numbers = [float(x) for x in rest.split()[:3]]
                self.vertices.append(numbers) if word == "v" else self.uvs.append((numbers + [0])[:2])
            elif word == "usemtl":
                if rest.strip() not in self.materials:
                    self.materials.append(rest.strip())
                current = self.materials.index(rest.strip())
            elif word == "mtllib":
                self.libraries.append(path.parent / rest.strip())
            elif word == "f":
                corners = [(corner.split("/") + [""])[:2] for corner in rest.split()]
                self.faces.append([self.index(v, self.vertices) for v, _ in corners])
                self.face_uvs.append([self.index(uv, self.uvs) if uv else None for _, uv in corners])
                self.face_materials.append(current)

    @staticmethod
    def index(text, of):
        """From 0; negative numbers count from the end."""
        number = int(text)
        return number - 1 if number > 0 else len(of) + number

    def colours(self):
        """By material the diffuse colour and the image of the libraries."""
        found, name = {}, None
        for library in filter(pathlib.Path.is_file, self.libraries):
            for line in library.read_text(encoding="utf-8", errors="replace").splitlines():
                word, _, rest = line.strip().partition(" ")
                if word == "newmtl":
                    name = rest.strip()
                    found[name] = {}
                elif word == "Kd" and name:
                    found[name]["colour"] = [float(x) for x in rest.split()[:3]]
                elif word == "map_Kd" and name:
                    found[name]["image"] = library.parent / rest.split()[-1]
        return found


def linear(colour):
    """Of a colour in hexadecimal digits."""
    parts = [int(colour[i:i + 2], 16) / 255 for i in (0, 2, 4)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]


def make_material(name, colour, roughness, image=None):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.diffuse_color = (*colour, 1)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Roughness"].default_value = roughness
    if image and image.is_file():
        texture = nodes.new("ShaderNodeTexImage")
        texture.image = bpy.data.images.load(str(image))
        links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    return material


def make_object(name, vertices, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def shade_smooth(mesh):
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if hasattr(mesh, "use_auto_smooth"):  # up to Blender 4.0
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, CREASE
    else:
        mesh.set_sharp_from_angle(angle=CREASE)


def add_texture_coordinates(mesh, obj):
    if not obj.uvs:
        return
    corners = [obj.uvs[uv] if uv is not None else (0, 0) for face in obj.face_uvs for uv in face]
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", np.ravel(corners))


def add_materials(mesh, obj, name, colour):
    known = obj.colours()
    for material in obj.materials or [name]:
        found = known.get(material, {})
        mesh.materials.append(make_material(material, found.get("colour", colour), 0.5, found.get("image")))
    mesh.polygons.foreach_set("material_index", obj.face_materials)


def add_body(run, name, colour):
    obj = Obj(run.folder / f"{name}.obj")
    if len(obj.vertices) != run.samples(name).shape[1]:
        raise SystemExit(f"error: {run.folder / name}.obj: has not as many vertices as the point cache; take both from one run")
    body = make_object(name, obj.vertices, obj.faces)
    body.matrix_world = run.turn.to_4x4()  # as Blender's own importer does; the axes of the modifier are the other way round
    add_texture_coordinates(body.data, obj)
    add_materials(body.data, obj, name, colour)
    shade_smooth(body.data)
    cache = body.modifiers.new("motion", "MESH_CACHE")
    cache.cache_format, cache.filepath = "PC2", str(run.cache(name).resolve())
    cache.frame_start = 0
    return body


def place_of(run, place):
    """Translation and rotation in Blender's axes."""
    return run.turn @ Vector(place[:3]), (run.turn @ Quaternion(place[3:]).to_matrix() @ run.turn.transposed()).to_quaternion()


def animate(thing, path, values):
    """Keys of a vector in every frame, with straight lines between."""
    curves = thing.animation_data.action.fcurves
    for i in range(len(values[0])):
        keys = curves.new(path, index=i).keyframe_points
        keys.add(len(values))
        keys.foreach_set("co", np.ravel([(k, value[i]) for k, value in enumerate(values)]))
        for key in keys:
            key.interpolation = "LINEAR"


def add_mesh_obstacle(run, obstacle, places):
    thing = make_object(obstacle["name"], [run.turn @ Vector(v) for v in obstacle["vertices"]], obstacle["faces"])
    thing.rotation_mode = "QUATERNION"
    moved = [place_of(run, place) for place in places]
    for before, after in zip(moved, moved[1:]):
        after[1].make_compatible(before[1])
    thing.location, thing.rotation_quaternion = moved[0]
    if any(place != places[0] for place in places):
        thing.animation_data_create().action = bpy.data.actions.new(obstacle["name"])
        animate(thing, "location", [location for location, _ in moved])
        animate(thing, "rotation_quaternion", [rotation for _, rotation in moved])
    return thing


def add_plane(run, obstacle, least, most):
    """A square that reaches far beyond the whole motion."""
    normal, point = run.turn @ Vector(obstacle["normal"]), run.turn @ Vector(obstacle["point"])
    centre = Vector((least + most) / 2)
    half = 20 * Vector(most - least).length
    plane = make_object(obstacle["name"], [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [(0, 1, 2, 3)])
    plane.location = centre - normal.dot(centre - point) * normal
    plane.rotation_euler = normal.to_track_quat("Z", "Y").to_euler()
    return plane


def add_obstacles(run, least, most):
    for i, obstacle in enumerate(run.obstacles):
        if "normal" in obstacle:
            thing = add_plane(run, obstacle, least, most)
        else:
            thing = add_mesh_obstacle(run, obstacle, [places[i] for places in run.places])
        thing.data.materials.append(make_material(obstacle["name"], linear(GREY), 0.8))


def set_times(run):
    scene = bpy.context.scene
    scene.render.fps = min(32767, max(1, round(run.rate())))
    scene.render.fps_base = scene.render.fps / run.rate()
    scene.frame_start, scene.frame_end = 0, len(run.times) - 1
    scene.frame_set(0)


def add_light_and_camera(least, most):
    scene = bpy.context.scene
    centre, size = Vector((least + most) / 2), Vector(most - least).length
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle = 2.6, 0.12
    sun.rotation_euler = Vector((-0.5, 0.45, -1)).to_track_quat("-Z", "Y").to_euler()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens, camera.data.clip_end, camera.data.clip_start = 50, 100 * size, 0.01 * size
    camera.location = centre + 1.25 * size * Vector((0.25, -1, 0.42)).normalized()
    camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
    for thing in (sun, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.world = scene.world or bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (0.85, 0.92, 1, 1), 0.45


def render(options):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples = "CPU", options.samples
    try:
        scene.cycles.use_denoising, scene.cycles.denoiser = True, "OPENIMAGEDENOISE"
    except TypeError:  # a Blender without it
        scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = options.width, options.width * 9 // 16
    scene.render.resolution_percentage = 100
    scene.render.filepath = str(options.render.resolve())
    scene.frame_set(options.frame if options.frame is not None else scene.frame_end // 2)
    bpy.ops.render.render(write_still=True)


def main():
    options = parse_arguments()
    run = Run(options.folder)
    if not bpy.data.filepath:  # the cube that Blender begins with
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
    least, most = run.bounds()
    for i, name in enumerate(run.bodies):
        add_body(run, name, linear(COLOURS[i % len(COLOURS)]))
    add_obstacles(run, least, most)
    set_times(run)
    add_light_and_camera(least, most)
    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=str(options.save.resolve()))
    if options.render:
        render(options)


if __name__ == "__main__":
    try:
        main()
    except OSError as error:
        sys.exit(f"error: {error}")
