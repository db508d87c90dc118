"""Universal Ctags, asked of the project's files."""
import subprocess


def tags(paths, root, *options):
    """Name, path and fields of what Universal Ctags finds in the files."""
    done = subprocess.run(
        ["ctags", "--languages=C++", "--language-force=C++", *options, "-f", "-", "-L", "-"],
        cwd=root,
        input="\n".join(paths),
        capture_output=True,
        text=True,
        errors="replace",
        check=True,
    )
    return [tag.split("\t", 2) for tag in done.stdout.splitlines() if not tag.startswith("!")]
