#!/usr/bin/env python3
"""Runs a planner over instances under limits of CPU time and memory, one JSON record a run; resumable.

  run.py --root TREE --planner roci --command 'roci-plan {domain} {problem}' --out roci.jsonl \
         --validate build/release/bin/roci-validate

The plan is what the command prints, or the file {plan} where the command names one. What stands in --out already is not
run again. A run that is still going at twice its CPU limit in wall time ends as timeout."""

import argparse
import csv
import json
import os
import pathlib
import platform
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import instances


def measured(arguments, command, folder, out, err, around=()):
    """Exit status, CPU seconds and peak memory in KiB of a command; killed after twice its CPU limit and 5 s. `around` are words
    that start it, limits and all, and are not measured."""
    report = pathlib.Path(folder) / "report"
    limits = [*around, arguments.limited, report, str(arguments.seconds), str(arguments.megabytes)]
    process = subprocess.Popen([*limits, *command], stdout=out, stderr=err, cwd=folder, start_new_session=True)
    try:
        process.wait(2 * arguments.seconds + 5)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGXCPU)
        process.wait()
    code, cpu, peak = report.read_text().split()
    return int(code), float(cpu), int(peak)


def run(arguments, instance):
    with tempfile.TemporaryDirectory() as folder:
        plan = pathlib.Path(folder) / "plan"
        stats = pathlib.Path(folder) / "stats"
        names = {"domain": instance.domain_file, "problem": instance.problem_file, "values": values_of(instance),
                 "plan": plan, "stats": stats}
        command = [part.format(**names) for part in shlex.split(arguments.command)]
        command[0] = str(pathlib.Path(shutil.which(command[0]) or command[0]).resolve())
        with open(pathlib.Path(folder) / "stdout", "w+b") as out, open(pathlib.Path(folder) / "stderr", "w+b") as err:
            begin = time.monotonic()
            code, cpu, peak = measured(arguments, command, folder, out, err)
            wall = time.monotonic() - begin
            out.seek(0)
            err.seek(0)
            text = plan.read_bytes() if plan.exists() else out.read()
            plan.write_bytes(text)
            record = {
                "planner": arguments.planner, "domain": instance.domain, "instance": instance.number,
                "seconds": arguments.seconds, "megabytes": arguments.megabytes, "host": platform.node(),
                "processor": processor(), "revision": arguments.revision, "exit": code, "cpu_s": round(cpu, 6), "wall_s": round(wall, 3),
                "peak_rss_kb": peak, "message": err.read(2000).decode(errors="replace").strip(),
            }
            if stats.exists():
                record["stats"] = json.loads(stats.read_text())
        record.update(judge(arguments, instance, plan, code))
        return record


def processor():
    """The processor's name, as the kernel tells it."""
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def values_of(instance):
    """The file beside the problem with the values of its external functions, if it has any."""
    return pathlib.Path(instance.problem_file).with_suffix(".values")


def judge(arguments, instance, plan, code):
    """What the validator says of the plan, if there is one."""
    if code in (-signal.SIGXCPU, -signal.SIGKILL):
        return {"status": "timeout", "valid": False}
    actions = sum(line.lstrip()[:1].isdigit() for line in plan.read_text(errors="replace").splitlines())
    if code != 0 and actions == 0:
        return {"status": f"exit {code}", "valid": False}
    values = values_of(instance)
    functions = ["--functions", values] if values.exists() else []
    verdict = subprocess.run([arguments.validate, instance.domain_file, instance.problem_file, plan, "--json", *functions],
                             capture_output=True, text=True, timeout=600)
    if verdict.returncode == 2:
        return {"status": "unreadable plan", "valid": False}
    report = json.loads(verdict.stdout)
    return {"status": "ok" if report["valid"] else "invalid plan", "valid": report["valid"],
            "makespan": report["makespan"], "metric": report.get("metric"), "actions": actions}


def chosen(arguments):
    found = instances.find(arguments.root)
    if arguments.only:
        with open(arguments.only) as file:
            wanted = {(row["domain"], int(row["instance"])) for row in csv.DictReader(file)}
        found = [instance for instance in found if instance.key in wanted]
    if arguments.match:
        found = [instance for instance in found if arguments.match in instance.domain]
    return instances.sample(found, arguments.per_domain)


def done(path):
    if not path.exists():
        return set()
    return {(record["planner"], record["domain"], record["instance"])
            for record in map(json.loads, path.read_text().splitlines())}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", required=True, help="the benchmark tree")
    parser.add_argument("--planner", required=True, help="name in the records")
    parser.add_argument("--command", required=True, help="with {domain} {problem}, {values} of external functions, and {plan} {stats} if it writes files")
    parser.add_argument("--out", required=True, type=pathlib.Path, help="JSON lines; appended to")
    parser.add_argument("--validate", default="roci-validate")
    parser.add_argument("--limited", default="build/release/bin/roci-bench-limited", type=lambda p: str(pathlib.Path(p).resolve()),
                        help="the program that limits and measures a run")
    parser.add_argument("--seconds", type=int, default=30, help="of CPU time")
    parser.add_argument("--megabytes", type=int, default=4096, help="of address space")
    parser.add_argument("--only", help="a CSV with columns domain and instance: those alone")
    parser.add_argument("--match", help="domains whose name contains this")
    parser.add_argument("--per-domain", type=int, default=0, help="at most so many of each domain; 0: all")
    parser.add_argument("--revision", default="", help="of the planner, for the records")
    arguments = parser.parse_args()
    known = done(arguments.out)
    for instance in chosen(arguments):
        if (arguments.planner, *instance.key) in known:
            continue
        record = run(arguments, instance)
        with open(arguments.out, "a") as file:
            file.write(json.dumps(record) + "\n")
        print(f'{record["status"]:14} {record["cpu_s"]:8.2f} s {record["peak_rss_kb"] // 1024:6} MB  '
              f"{instance.domain} {instance.number}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
