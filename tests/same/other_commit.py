"""The binary of another commit, built in a worktree of its own below build/same.

Alone: `other_commit.py COMMIT` prints where it is.
"""
import os
import pathlib
import subprocess
import sys


class BuildFailed(Exception):
    pass


def git(root, *arguments):
    done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=False)
    if done.returncode:
        raise BuildFailed(f"git {' '.join(arguments)}: {done.stderr.strip()}")
    return done.stdout.strip()


def name_of(root, commit):
    return git(root, "rev-parse", "--verify", "--short=12", f"{commit}^{{commit}}")


def binary_of(root, commit, say):
    """Path of the commit's ncvet; what was built before is used again."""
    name = name_of(root, commit)
    folder = pathlib.Path(root) / "build/same" / name
    if not (folder / ".git").exists() or name_of(folder, "HEAD") != name:
        folder.parent.mkdir(parents=True, exist_ok=True)
        git(root, "worktree", "prune")
        git(root, "worktree", "add", "--force", "--detach", str(folder), name)
    say(f"building ncvet of {name}")
    jobs = ["-j", os.environ["NCVET_JOBS"]] if os.environ.get("NCVET_JOBS") else []
    for command in (
        ["cmake", "--preset", "release", "--log-level=WARNING"],
        ["cmake", "--build", "build/release", *jobs, "--target", "ncvet", "--", "--quiet"],
    ):
        done = subprocess.run(
            command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
        )
        if done.returncode:
            raise BuildFailed(f"{' '.join(command)} in {folder}:\n{done.stdout[-4000:]}")
    return str(folder / "build/release/ncvet")


if __name__ == "__main__":
    try:
        print(binary_of(pathlib.Path.cwd(), sys.argv[1], lambda text: print(f"bench: {text}", file=sys.stderr)))
    except BuildFailed as problem:
        sys.exit(str(problem))
