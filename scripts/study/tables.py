"""What the runs have found, as Markdown."""
import numpy as np

from common.machine import description, load_remark
from common.markdown import table

from . import measures, time_schemes
from .problems import BEAM, BENDING, HARD, PROBLEMS, QUADRUPOLE, ROD, SOFT, SPHERE
from .settings import BASE, COLLOCATION, DISCRETISATIONS, GALERKIN, Setting

SCENES = {scene: name for name, problem in PROBLEMS.items() for scene in problem.scenes}
TITLES = {"rod-fixed": "Rod, one end fixed", "rod-free": "Rod, free", "sphere": "Sphere under pressure",
          "sphere-0": "Sphere under pressure, ν = 0", "sphere-45": "Sphere under pressure, ν = 0.45",
          "mode": "Free mode S2 of a sphere", "beam": "Held beam under gravity", "beam-free": "Free beam, first bending mode", "torsion": "Free mode T2 of a sphere",
          "plate-twist": "Free plate, mode x y", "plate-saddle": "Free plate, mode x² - y²", "ringing": "Free beam, a hundred periods", "tumble": "Tumbling box",
          "slide": "Sliding block", "drop": "Flat drop of a cube", "ball": "Ball on a floor"}


def number(value, digits=2):
    """Short: 0.0134, 1.2e-05; – for nothing."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    text = f"{value:.{digits}g}" if 1e-3 <= abs(value) < 1e4 else f"{value:.{max(digits - 1, 0)}e}"
    return text.replace("e-0", "e-").replace("e+0", "e")


def megabytes(value):
    return number(value / 1e6, 3)


def error(record):
    if record is None:
        return ""
    return record["failed"].split(" ")[0] if "failed" in record else number(record["error"], 3)


def per_second(record):
    return record["simulate_cpu"] / record["simulated"]


def peak_memory(record):
    """[bytes] of both programs, the larger one."""
    return max(record["precompute_memory"], record["simulate_memory"])


def of_scene(found, scene):
    """{key without the scene: record}"""
    records = found.get(SCENES[scene], {})
    return {key.split(": ", 1)[1]: r for key, r in records.items() if key.startswith(scene + ": ")}


def plain(records, discretisation=GALERKIN):
    """Those with nothing but a mesh, time step, scheme and discretisation; the model "rigid" has none."""
    return {k: r for k, r in records.items() if r["error"] is not None and
            k == Setting(r["mesh"], r["steps"], r["scheme"], discretisation=discretisation).key()}


def pressed(sphere):
    return lambda scheme, steps: time_schemes.error(time_schemes.sphere_surface(sphere), lambda t: sphere.pressed(t) / sphere.static,
                                                    scheme, sphere.breathing_period(), steps)


def pulled(fixed):
    return lambda scheme, steps: time_schemes.error(time_schemes.rod_end(fixed), lambda t: ROD.end(t, fixed) / ROD.STATIC,
                                                    scheme, ROD.PERIOD, steps)


def ringing(mode):
    return lambda scheme, steps: time_schemes.ringing_measures(mode.frequency, scheme, mode.period, steps)["error"]


# scene: error of the time discretisation alone, by scheme and steps per period
EXACT_IN_SPACE = {"rod-fixed": pulled(True), "rod-free": pulled(False), "sphere": pressed(SPHERE), "sphere-0": pressed(SOFT),
                  "sphere-45": pressed(HARD), "mode": ringing(QUADRUPOLE), "beam-free": ringing(BENDING),
                  "beam": lambda scheme, steps: time_schemes.error(time_schemes.beam_tip, lambda t: BEAM.tip(t) / BEAM.static(),
                                                                   scheme, BEAM.period(), steps)}


def values(records, name):
    return list(dict.fromkeys(r[name] for r in records.values()))


def table_front(found, scene):
    """The settings that no other one beats in error and CPU seconds (both programs, two periods)."""
    runs = [(r["precompute_cpu"] + r["simulate_cpu"], r["error"], key, r)
            for key, r in of_scene(found, scene).items() if r["error"] is not None]
    rows = [[number(e, 3), key, r["nodes"], number(r["precompute_cpu"]), number(per_second(r)),
             megabytes(r["archive_bytes"]), megabytes(peak_memory(r))]
            for _, e, key, r in measures.pareto(runs)]
    return table(["error", "setting", "nodes", "precompute [CPU s]", "simulation [CPU s per s]", "archive [MB]",
                  "memory [MB]"], rows)


def table_schemes(found, scene):
    """Errors, and orders in time, of the discretisations and of the time discretisation alone."""
    of_all = of_scene(found, scene)
    grids = {d: plain(of_all, d) for d in DISCRETISATIONS}
    every = {k: r for records in grids.values() for k, r in records.items()}
    meshes, steps = sorted(values(every, "mesh")), sorted(values(every, "steps"))
    rows = []
    for scheme in values(every, "scheme"):
        for discretisation, records in grids.items():
            for mesh in meshes:
                runs = [records.get(Setting(mesh, s, scheme, discretisation=discretisation).key()) for s in steps]
                if scheme == "rigid" or sum(r is not None for r in runs) < 2:
                    continue
                seen = [(s, r["error"]) for s, r in zip(steps, runs) if r]
                rows.append([scheme, discretisation, next(r for r in runs if r)["nodes"], *map(error, runs),
                             f"{-measures.order(*zip(*seen)):.1f}"])
        if scene in EXACT_IN_SPACE and rows:
            alone = [EXACT_IN_SPACE[scene](scheme, s) for s in steps]
            rows.append([scheme, "exact in space", "", *(number(e, 3) for e in alone), f"{-measures.order(steps, alone):.1f}"])
    return table(["scheme", "in space", "nodes", *(f"{s} steps" for s in steps), "order in dt"], rows)


def table_meshes(found):
    """Orders in the mesh size, with the default scheme and the most steps, from the two finest meshes."""
    rows = []
    for scene in SCENES:
        for discretisation in DISCRETISATIONS:
            records = plain(of_scene(found, scene), discretisation)
            for s in sorted(values(records, "steps"))[-2:]:
                seen = sorted((r["mesh"], r["error"], r["nodes"]) for r in records.values()
                              if r["scheme"] == BASE and r["steps"] == s)
                if len(seen) >= 2:
                    rows.append([TITLES[scene], discretisation, s, ", ".join(f"{number(e, 3)} ({n})" for _, e, n in seen),
                                 f"{-measures.order(*list(zip(*seen[-2:]))[:2]):.1f}"])
    return table(["problem", "in space", "steps per period", "error (nodes)", "order in h"], rows)


def whole_job(record):
    """[CPU s] of both programs for two periods."""
    return record["precompute_cpu"] + record["simulate_cpu"] * 2 / PROBLEMS[SCENES[record["scene"]]].periods


def table_targets(found, targets=(0.05, 0.02, 0.01)):
    """The cheapest runs that keep an error, with each discretisation: CPU seconds of both programs."""
    rows = []
    for scene in ("rod-fixed", "sphere", "beam"):
        for target in targets:
            row = [TITLES[scene], f"{100 * target:g} %"]
            for discretisation in DISCRETISATIONS:
                runs = [(whole_job({**r, "scene": scene}), r["archive_bytes"], key) for key, r in of_scene(found, scene).items()
                        if r["error"] is not None and r["error"] <= target and (COLLOCATION in key) == (discretisation == COLLOCATION)]
                cheapest = min(runs, default=None)
                row += [f"{number(cheapest[0])}, {megabytes(cheapest[1])} ({cheapest[2].replace(' ' + COLLOCATION, '')})"] if cheapest else ["–"]
            rows.append(row)
    return table(["problem", "error", *(f"{d} [CPU s], [MB]" for d in DISCRETISATIONS)], rows)


def sweep_rows(found, scene, name, reference=None):
    """(setting, record, difference of its motion from that with the change `reference`) of a sweep."""
    plan, records = PROBLEMS[SCENES[scene]].plan, of_scene(found, scene)
    best = None
    if reference and name in plan.sweeps:
        best = records.get(Setting(*plan.sweeps[name], **reference).key(), {}).get("series")
    for setting in plan.swept(name):
        record = records.get(setting.key())
        if record:
            off = None
            if best and record.get("series") and len(best) == len(record["series"]):
                off = measures.rms(np.array(best) - record["series"])
            yield setting, record, off


def table_sweep(found, name, column, describe, reference, scenes, extra=()):
    """A sweep of all scenes in one table: error / difference and costs."""
    rows = []
    for scene in scenes:
        for setting, r, off in sweep_rows(found, scene, name, reference):
            rows.append([TITLES[scene], describe(setting, r), error(r), number(off), number(r["precompute_cpu"]),
                         *([number(per_second(r)), megabytes(r["archive_bytes"])] if "failed" not in r else ["–", "–"]),
                         *(number(r.get(e), 4) for e in extra)])
    return table(["problem", column, "error", "motion differs by", "precompute [CPU s]", "simulation [CPU s per s]",
                  "archive [MB]", *extra], rows)


def table_codec(found):
    return table_sweep(found, "codec", "codec", lambda s, r: s.codec if s.codec == "none" else f"{s.codec} {s.codec_tol:g}",
                       {"codec": "none"}, ("rod-fixed", "sphere", "beam"))


def table_quadrature(found):
    return table_sweep(found, "quadrature", "tolerance", lambda s, r: f"{s.quadrature:g}", {"quadrature": 1e-8},
                       ("rod-fixed", "sphere", "beam"))


def table_corners(found):
    """Double nodes at the edges of the held face."""
    rows = []
    for scene in ("rod-fixed", "beam"):
        for setting, r, _ in sweep_rows(found, scene, "corners"):
            base = of_scene(found, scene).get(Setting(setting.mesh, setting.steps, discretisation=setting.discretisation).key())
            if base:
                without, double = (r, base) if setting.discretisation == GALERKIN else (base, r)
                rows.append([TITLES[scene], setting.discretisation, r["nodes"], f"{error(without)} / {error(double)}"])
    return table(["problem", "in space", "nodes", "error: single / double"], rows)


def table_history(found):
    rows = []
    for scene in ("rod-fixed", "sphere", "mode", "beam"):
        base = of_scene(found, scene).get(Setting(*PROBLEMS[SCENES[scene]].plan.sweeps["history"]).key())
        if not base:
            continue
        runs = [(r["history"], r) for _, r, _ in sweep_rows(found, scene, "history") if "history" in r]
        runs.append((base["history"], base))
        for n, r in sorted(runs, key=lambda run: run[0]):
            rows.append([TITLES[scene], f"{n}" + (" (default)" if r is base else ""), number(n / base["lam"]), error(r),
                         number(r.get("growth_factor"), 6), number(r.get("window"), 6), number(r["precompute_cpu"])])
    return table(["problem", "history [steps]", "of a traversal of shear waves", "error", "growth per step", "window",
                  "precompute [CPU s]"], rows)


def table_window(found):
    rows = []
    for scene in ("rod-fixed", "sphere", "mode", "beam-free", "beam"):
        for setting, r, _ in sweep_rows(found, scene, "window"):
            chosen = f"{setting.window} ({r['window']:.6g})" if setting.window == "auto" and "window" in r else setting.window
            rows.append([TITLES[scene], chosen, error(r), number(r.get("growth_factor"), 6), left_per_period(r)])
        rows += [[TITLES[scene], key.split("--damping ")[1], error(r), number(r.get("growth_factor"), 6), left_per_period(r)]
                 for key, r in of_scene(found, scene).items() if "--damping" in key]
    return table(["problem", "window or damping", "error", "growth per step without window",
                  "amplitude (beam) or energy (mode) left per period"], rows)


def left_per_period(record):
    return number(record.get("growth", record.get("energy")), 4) if {"growth", "energy"} & record.keys() else ""


def table_energy(found):
    grids = {d: plain(of_scene(found, "mode"), d) for d in DISCRETISATIONS}
    records = grids[GALERKIN]
    if not records:
        return ""
    finest = max(r["mesh"] for r in records.values() if r["scheme"] == "bdf1") if "bdf1" in values(records, "scheme") else max(values(records, "mesh"))
    steps = sorted({r["steps"] for r in records.values() if r["mesh"] == finest})
    rows = []
    for scheme in values(records, "scheme"):
        for d, runs in grids.items():
            rows.append([scheme, d, *(cell(runs.get(Setting(finest, s, scheme, discretisation=d).key())) for s in steps)])
        rows.append([scheme, "exact in space", *(cell(time_schemes.ringing_measures(QUADRUPOLE.frequency, scheme, QUADRUPOLE.period, s))
                                                 for s in steps)])
    nodes = next(r["nodes"] for r in records.values() if r["mesh"] == finest)
    return f"{nodes} nodes.\n\n" + table(["scheme", "in space", *(f"{s} steps per period" for s in steps)], rows)


def cell(record):
    return f"{100 * record['energy']:.1f} %, {100 * record['frequency']:+.2f} %" if record else ""


def shares(*seconds):
    """Per cent of their sum: phases of bemsim are wall seconds, which are more than CPU seconds on a busy machine."""
    return [f"{100 * s / sum(seconds):.0f}" for s in seconds]


PHASES = ("tables", "assembly", "inverse", "growth factor")


def table_phases(found, chosen):
    """Where CPU seconds go, per cent, in the runs (scene, setting)."""
    rows = []
    for scene, setting in chosen:
        r = of_scene(found, scene).get(setting.key())
        if not r or "failed" in r:
            continue
        phases, total = r["precompute_phases"], r["precompute_cpu"]
        parts = [phases.get(p, 0.0) for p in PHASES]
        steps = sum(v for k, v in r["simulate_phases"].items() if k != "output")
        rows.append([f"{TITLES[scene]}, {setting.key()}", r["nodes"], number(total, 3),
                     *(f"{100 * p / total:.0f}" for p in [*parts, total - sum(parts)]),
                     number(r["simulate_cpu"], 3), *shares(steps, r["simulate_phases"].get("output", 0), r["loading"])])
    return table(["run", "nodes", "precompute [CPU s]", *(f"{p} %" for p in (*PHASES, "rest")), "simulation [CPU s]",
                  "steps %", "output %", "loading %"], rows)


def table_slide(found):
    records = plain(of_scene(found, "slide")) | {k: r for k, r in of_scene(found, "slide").items() if r["scheme"] == "rigid"}
    rows = [[r["scheme"], r["nodes"], r["steps"], number(r["way"]), number(r["time"]), number(per_second(r))]
            for r in sorted(records.values(), key=lambda r: (r["scheme"], r["mesh"], r["steps"]))
            if r["scheme"] in (BASE, "rigid", "bdf1")]
    return table(["scheme", "nodes", "steps until rest", "error of the distance", "error of the time", "simulation [CPU s per s]"], rows)


def table_impact(found):
    """Contact against closed forms: 1 is exact."""
    rows = [["Flat drop of a cube", "", f"exact in space, {steps} steps {scheme}", number(time_schemes.rebound(scheme, steps), 3), "", "", ""]
            for steps, scheme in ((40, BASE), (80, BASE), (40, "bdf1"))]
    rows += [[TITLES[scene], r["nodes"], key.split(" ", 2)[2], *(number(r[k], 3) for k in ("rebound", "contact_time", "approach", "error"))]
            for scene in ("drop", "ball") for key, r in of_scene(found, scene).items() if r["error"] is not None]
    return table(["problem", "nodes", "steps per contact, scheme and options", "rebound", "contact time", "approach", "error"], rows)


def table_calculix(found):
    """Both programs on the beam and the rod: the fronts of error and CPU seconds (everything, two periods)."""
    rows = []
    for case in ("beam", "rod-fixed"):
        ours = [(r["precompute_cpu"] + r["simulate_cpu"] * (2 / PROBLEMS[SCENES[case]].periods), r["error"], "bem", key,
                 3 * r["nodes"], r["simulate_cpu"] / r["simulated"], peak_memory(r)) for key, r in plain(of_scene(found, case)).items()]
        theirs = [(r["cpu"], r["error"], "CalculiX", key.split(": ")[1], 3 * r["nodes"], r["cpu"] / r["simulated"],
                   r["memory"]) for key, r in found.get("calculix", {}).items() if r["case"] == case]
        stepped, modal = ([r for r in theirs if r[3].startswith("modes") == modes] for modes in (False, True))
        for runs in (measures.pareto(ours), measures.pareto(stepped), measures.pareto(modal)):
            rows += [[TITLES[case], program, setting, unknowns, number(e, 3), number(cost, 3), number(later, 3),
                      megabytes(memory)] for cost, e, program, setting, unknowns, later, memory in runs]
    return table(["problem", "program", "setting", "unknowns", "error", "two periods, everything [CPU s]",
                  "another second of motion [CPU s]", "memory [MB]"], rows)


def remark(found):
    long = 2  # CPU seconds; of shorter runs the script itself is a noticeable part
    records = [r for part in found.values() for r in part.values() if "cores_of_others" in r
               and r.get("cpu", 0) + r.get("precompute_cpu", 0) + r.get("simulate_cpu", 0) > long]
    return f"{description()}, one thread, CPU seconds.{load_remark(records)}" if records else ""
