"""Settings of a run and the lists of settings that the study goes through."""
import dataclasses

SCHEMES = ("bdf1", "theta:0.5", "theta:0.75", "bdf2", "radau2", "radau3")
BASE = "radau2"  # the default, which single factors are varied around
GALERKIN, COLLOCATION = DISCRETISATIONS = ("galerkin", "collocation")  # the default first


@dataclasses.dataclass(frozen=True)
class Setting:
    """`mesh` is the problem's measure of fineness, `steps` the number of time steps per period of the problem
    (docs/accuracy/speed-against-error.md), `history` 0 the default, `extra` more options of bemprecomp."""
    mesh: int
    steps: int
    scheme: str = BASE
    codec: str = "lowrank"
    codec_tol: float = 1e-4
    quadrature: float = 1e-6
    window: str = "auto"
    history: int = 0
    model: str = "dynamic"
    discretisation: str = GALERKIN
    extra: tuple = ()

    def options(self):
        """Of bemprecomp, without the time step."""
        if self.model != "dynamic":
            return ["--model", self.model]
        found = ["--scheme", self.scheme, "--codec", self.codec, "--quadrature-tol", self.quadrature,
                 "--window", self.window, "--discretisation", self.discretisation]
        if self.codec != "none":
            found += ["--codec-tol", self.codec_tol]
        if self.history:
            found += ["--history", self.history]
        return found + list(self.extra)

    def key(self):
        """Its name in the results: what differs from the defaults."""
        words = [f"mesh {self.mesh}", f"{self.steps} steps", self.scheme if self.model == "dynamic" else self.model]
        if self.discretisation != GALERKIN:
            words.append(self.discretisation)
        defaults = {f.name: f.default for f in dataclasses.fields(self)}
        for name in ("codec", "codec_tol", "quadrature", "window", "history"):
            value = getattr(self, name)
            if value != defaults[name]:
                words.append(f"{name} {value:g}" if isinstance(value, float) else f"{name} {value}")
        return " ".join(words + [str(e) for e in self.extra])


def in_both(*settings):
    """Settings with each discretisation."""
    return tuple(dataclasses.replace(s, discretisation=d) for s in settings for d in DISCRETISATIONS)


@dataclasses.dataclass(frozen=True)
class Plan:
    """What is run of a problem: all schemes with both discretisations for `grids` of (meshes, steps), but those in
    `most_steps` only up to so many; single factors about a base, {sweep: (mesh, steps)}; and more settings."""
    grids: tuple
    sweeps: dict = dataclasses.field(default_factory=dict)
    more: tuple = ()
    most_steps: dict = dataclasses.field(default_factory=dict)

    def settings(self, schemes):
        found = list(in_both(*(Setting(m, s, scheme) for meshes, steps in self.grids for m in meshes for s in steps
                               for scheme in schemes if s <= self.most_steps.get(scheme, s))))
        for name in self.sweeps:
            found += self.swept(name)
        return sorted(dict.fromkeys([*found, *self.more]), key=lambda s: (s.mesh, s.steps))  # cheap ones first

    def swept(self, name):
        """The settings of a sweep; none if the problem has not that sweep."""
        return [Setting(*self.sweeps[name], **change) for change in SWEEPS[name]] if name in self.sweeps else []


SWEEPS = {
    "codec": [{"codec": "none"}, *({"codec_tol": t} for t in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)),
              {"codec": "haar", "codec_tol": 1e-3}],
    "quadrature": [{"quadrature": t} for t in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8)],
    "window": [{"window": w, "discretisation": COLLOCATION} for w in ("1", "auto", "0.9995", "0.999", "0.998", "0.995", "0.99", "0.98")],
    "history": [{"history": n} for n in (4, 8, 12, 16, 20, 24, 32)],
    "corners": [{"extra": ("--corner-angle-deg", "none")}, {"extra": ("--corner-angle-deg", 40), "discretisation": COLLOCATION}],
}
