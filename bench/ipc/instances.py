"""Instances of a benchmark tree: YEAR/DOMAIN/instances/instance-N.pddl, with one domain.pddl for all beside the folder or
domains/domain-N.pddl for each."""

import dataclasses
import pathlib
import re


@dataclasses.dataclass(frozen=True)
class Instance:
    domain: str  # "ipc-2014/satellite-temporal-satisficing"
    number: int
    domain_file: pathlib.Path
    problem_file: pathlib.Path

    @property
    def key(self):
        return self.domain, self.number


def find(root):
    """All instances under root, by domain and number."""
    root = pathlib.Path(root).resolve()
    found = []
    for problem in root.glob("*/*/instances/instance-*.pddl"):
        number = int(re.fullmatch(r"instance-(\d+)", problem.stem).group(1))
        folder = problem.parent.parent
        own = folder / "domains" / f"domain-{number}.pddl"
        domain_file = own if own.exists() else folder / "domain.pddl"
        found.append(Instance(str(folder.relative_to(root)), number, domain_file, problem))
    return sorted(found, key=lambda instance: instance.key)


def sample(instances, per_domain):
    """At most so many of each domain, spread over its numbers; 0: all."""
    if per_domain == 0:
        return instances
    chosen = []
    for domain in dict.fromkeys(instance.domain for instance in instances):
        own = [instance for instance in instances if instance.domain == domain]
        count = min(per_domain, len(own))
        chosen += [own[i * len(own) // count] for i in range(count)]
    return chosen
