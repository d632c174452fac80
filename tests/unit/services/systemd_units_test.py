"""Units as systemd itself judges them: they can be read, and what a service that was taken over could reach is little
(systemd-analyze security, exposure 4.0 at most). Exits with 77 where there is no systemd.

systemd_units_test.py [FOLDER]: the units that cmake --install has put down in FOLDER, with the program that they start; else those
of the source folder, with a stand-in for it.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
EXPOSURE = "40"  # in tenths
SOURCE = pathlib.Path(__file__).resolve().parents[3] / "services" / "systemd"
# Newer systemd knows them, older ones pass over them.
NEWER_KEYS = ("RestartSteps", "RestartMaxDelaySec")


def analyze(folder, *arguments):
    environment = {**os.environ, "XDG_RUNTIME_DIR": str(folder), "SYSTEMD_PAGER": ""}
    ended = subprocess.run(["systemd-analyze", *arguments], env=environment, capture_output=True, text=True, check=False)
    return ended.returncode, ended.stdout + ended.stderr


def installed_unit(units):
    return (units / "rocinante@.service").read_text()


def unit_with_stand_in(folder):
    launcher = folder / "roci-launch"
    launcher.write_text("#!/bin/sh\n")
    launcher.chmod(0o755)
    return (SOURCE / "rocinante@.service.in").read_text().replace("@bin@", str(folder))


def main():
    if shutil.which("systemd-analyze") is None:
        print("skipped: there is no systemd-analyze (Debian package systemd), so nobody has read the units or judged their exposure")
        return SKIPPED
    failures = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        template = installed_unit(pathlib.Path(sys.argv[1])) if len(sys.argv) > 1 else unit_with_stand_in(folder)
        unit = folder / "rocinante@exec_svc.service"
        unit.write_text(template)
        shutil.copy((pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else SOURCE) / "rocinante.target", folder)
        for each in (unit, folder / "rocinante.target"):
            code, text = analyze(folder, "--user", "verify", "--man=no", str(each))
            findings = [line for line in text.splitlines()
                        if str(folder) in line and not any(f"'{key}'" in line for key in NEWER_KEYS)]
            if code != 0 or findings:
                failures.append(f"verify {each.name}: code {code}\n" + text)
        code, text = analyze(folder, "security", "--offline=true", "--threshold=" + EXPOSURE, "--no-pager", str(unit))
        print(next((line for line in text.splitlines() if "exposure" in line), "no verdict"))
        if code != 0:
            failures.append(f"security: more exposed than {int(EXPOSURE) / 10}\n" + text)
    for key in ("MemoryMax=", "NoNewPrivileges=yes", "ProtectSystem=strict", "RestrictAddressFamilies="):
        if key not in template:
            failures.append("the unit does without " + key)
    print("\n".join(failures))
    return 1 if failures else 0


sys.exit(main())
