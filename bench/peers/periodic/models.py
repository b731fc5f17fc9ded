"""Model files of the chains, for halfshaft: `python3 models.py` rewrites those kept in models/."""

from pathlib import Path

import cases

FOLDER = Path(__file__).resolve().parent / "models"


def text(line, name, remark):
    """A chain as a model file; shaft 1 goes to ground, shaft i + 1 from inertia i to the next."""
    parts = [f'# {remark}\nformat = 1\nname = "{name}"\n']
    for i, (inertia, ground) in enumerate(zip(line.inertia, line.ground), 1):
        parts.append(f'[[inertia]]\nname = "inertia {i}"\ninertia = {inertia!r}\ndamping = {ground!r}\n')
    laws = zip(line.stiffness, line.cubic, line.damping)
    for i, (stiffness, cubic, damping) in enumerate(laws, 1):
        ends = ("inertia 1", "ground") if i == 1 else (f"inertia {i - 1}", f"inertia {i}")
        shaft = [f'[[shaft]]\nname = "shaft {i}"\nfrom = "{ends[0]}"\nto = "{ends[1]}"',
                 f"stiffness = {stiffness!r}"]
        shaft += [f"cubic = {cubic!r}"] if cubic else []
        shaft += [f"damping = {damping!r}"] if damping else []
        parts.append("\n".join(shaft) + "\n")
    node = line.torque.index(1.0) + 1
    parts.append(f'[[torque]]\nname = "excitation"\non = "inertia {node}"\namplitude = {line.amplitude!r}\n')
    return "\n".join(parts)


def one_nonlinear(count, folder):
    """Writes the line with one nonlinear shaft and returns the file."""
    path = Path(folder) / f"one-nonlinear-shaft-{count}.toml"
    path.write_text(text(cases.one_nonlinear(count), f"One nonlinear shaft before {count} inertias",
                         "Written by bench/peers/periodic/models.py."))
    return path


def main():
    """Rewrites the chains."""
    for count, word in ((10, "ten"), (50, "fifty")):
        (FOLDER / f"chain-of-{word}.toml").write_text(text(
            cases.chain(count), f"Chain of {word}, every shaft between inertias nonlinear",
            "Written by bench/peers/periodic/models.py."))


if __name__ == "__main__":
    main()
