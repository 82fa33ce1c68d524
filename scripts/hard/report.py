"""What the hard cases have come to, as a Markdown table and as JSON."""
from common.markdown import table

SIGNS = {"<=": "≤", ">=": "≥"}


def number(value):
    """Two digits."""
    if value is None:
        return "missing"
    return f"{value:.2g}".replace("e-0", "e-").replace("e+0", "e")


def bounds_of(trial, short):
    return {**trial.bounds, **(trial.short_bounds if short else {})}


def worst(case, outcomes, short):
    """Of every figure that has a bound: {(figure, kind, bound): the worst value of all runs}."""
    found = {}
    for trial in case.trials:
        if trial.name not in outcomes:
            continue
        for figure, (kind, bound) in bounds_of(trial, short).items():
            value = outcomes[trial.name].figures.get(figure)
            key = (figure, kind, bound)
            values = [v for v in (found.get(key), value) if v is not None]
            found[key] = (max if kind == "<=" else min)(values) if values else None
    return found


def remarks(case, outcomes):
    """How many runs there are, and how many have to end early."""
    trials = [t for t in case.trials if t.name in outcomes]
    words = [f"{len(trials)} run{'s' if len(trials) != 1 else ''}"]
    for way in ("refused", "stopped"):
        count = sum(t.ends == way for t in trials)
        words += [f"{count} {way}"] if count else []
    return ", ".join(words)


def markdown(cases, found, short):
    rows = []
    for name, outcomes in found.items():
        figures = worst(cases[name], outcomes, short)
        failed = [trial for trial, outcome in outcomes.items() if outcome.faults]
        rows.append([f"{name} ({remarks(cases[name], outcomes)})", cases[name].expected,
                     "; ".join(f"{figure} {number(value)}" for (figure, _, _), value in figures.items()),
                     "; ".join(f"{SIGNS[kind]} {number(bound)}" for _, kind, bound in figures),
                     "FAIL: " + ", ".join(failed) if failed else "pass",
                     f"{sum(outcome.seconds for outcome in outcomes.values()):.0f}"])
    return table(["case", "expected", "worst figures", "bounds", "result", "CPU [s]"], rows)


def results(cases, found, short):
    """Everything, for JSON."""
    return {name: {"expected": cases[name].expected,
                   "passed": not any(outcome.faults for outcome in outcomes.values()),
                   "cpu_seconds": sum(outcome.seconds for outcome in outcomes.values()),
                   "runs": {trial.name: run_json(trial, outcomes[trial.name], short)
                            for trial in cases[name].trials if trial.name in outcomes}}
            for name, outcomes in found.items()}


def run_json(trial, outcome, short):
    return {"ends": trial.ends, "figures": outcome.figures,
            "bounds": {figure: list(bound) for figure, bound in bounds_of(trial, short).items()},
            "faults": outcome.faults, "messages": outcome.messages, "cpu_seconds": outcome.seconds}
