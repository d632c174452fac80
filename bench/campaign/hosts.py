"""Hosts of one flight: network namespaces on a switch, in the mount and network namespaces of this process alone."""

import subprocess
from itertools import combinations
from threading import Lock

ADDRESS = {"robot": "10.79.0.1", "first": "10.79.0.2", "second": "10.79.0.3"}
SWITCH = "switch"


def run(*words: str) -> None:
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


class Hosts:
    """One host is the namespace of this process, on loopback; three are namespaces of their own, each with its own name."""

    def __init__(self, names: list[str]):
        self.names = names
        self.alone = len(names) == 1
        self.cut: set[frozenset[str]] = set()
        self.unplugged: set[str] = set()
        self.lock = Lock()
        run("ip", "link", "set", "lo", "up")
        if self.alone:
            return
        run("mkdir", "-p", "/run/netns")
        run("mount", "-t", "tmpfs", "tmpfs", "/run/netns")  # seen by this process alone
        run("ip", "link", "add", "name", SWITCH, "type", "bridge")
        run("ip", "link", "set", SWITCH, "up")
        for name in names:
            run("ip", "netns", "add", name)
            run("ip", "link", "add", "name", "eth", "netns", name, "type", "veth", "peer", "name", name)
            run("ip", "-n", name, "addr", "add", f"{ADDRESS[name]}/24", "dev", "eth")
            run("ip", "-n", name, "link", "set", "lo", "up")
            run("ip", "-n", name, "link", "set", "eth", "up")
            run("ip", "link", "set", name, "master", SWITCH, "up")

    def on(self, name: str, command: list[str]) -> list[str]:
        """The command as it is run on a host; the process that runs it becomes the command."""
        if self.alone:
            return command
        named = ["unshare", "--uts", "sh", "-c", 'hostname "$0" && exec "$@"', name]
        return ["ip", "netns", "exec", name, *named, *command]

    def network(self, name: str) -> list[str]:
        if self.alone:
            return ["--domain", "7"]
        return ["--domain", "7", "--peers", ",".join(ADDRESS[other] for other in self.names), "--address", ADDRESS[name]]

    def part(self, link: str, parted: bool) -> None:
        """A cut of one link, "a-b": both hosts still hear the third, and nobody is told."""
        with self.lock:
            pair = frozenset(link.split("-"))
            self.cut = self.cut | {pair} if parted else self.cut - {pair}
            self._set_ports()

    def unplug(self, name: str, unplugged: bool) -> None:
        """The cable of a host: its interface has no carrier meanwhile."""
        with self.lock:
            self.unplugged = self.unplugged | {name} if unplugged else self.unplugged - {name}
            run("ip", "link", "set", name, "down" if unplugged else "up")
            self._set_ports()

    def _set_ports(self) -> None:
        # Isolated ports do not hear each other; a port that is cut off from both others is silent.
        degree = {name: sum(name in pair for pair in self.cut) for name in self.names}
        silent = {name for name in self.names if degree[name] == 2}
        left = [pair for pair in combinations(self.names, 2) if frozenset(pair) in self.cut and not silent & set(pair)]
        isolated = {name for pair in left for name in pair}
        for name in set(self.names) - self.unplugged:
            run("bridge", "link", "set", "dev", name, "isolated", "on" if name in isolated else "off")
            run("bridge", "link", "set", "dev", name, "state", "0" if name in silent else "3")
