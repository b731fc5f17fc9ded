"""Tables as all comparisons print them."""


def plain(head, lines):
    """Aligned columns."""
    widths = [max(len(line[i]) for line in (head, *lines)) for i in range(len(head))]
    body = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |"
            for line in (head, *lines)]
    body.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(body) + "\n"
