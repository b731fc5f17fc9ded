//! Figures used by several tests.

use halfshaft_present::figure::{
    Axis, Colour, Curve, Figure, Label, Line, Panel, Points, Reference, Region,
};

/// A text that breaks whatever does not protect it.
pub const HOSTILE: &str = "<script>alert('&\"')</script> ]]> %{x} $y$ </text>";

/// One curve from (0, 0) to (10, 10) on axes that show just that.
pub fn diagonal() -> Figure {
    let panel = Panel::new(
        Axis::new("x", "m").with_range(0.0, 10.0),
        Axis::new("y", "s").with_range(0.0, 10.0),
    )
    .with(Curve::new("diagonal", vec![0.0, 10.0], vec![0.0, 10.0], Colour::Blue).unlisted());
    Figure::new("diagonal", "").with(panel)
}

/// One of each kind of item, all with the same text, under a secondary axis.
pub fn one_of_each(text: &str) -> Figure {
    let x = Axis::new(text, text).with_secondary(text, text, 9.5);
    let y = Axis::new(text, "").with_secondary(text, "", 1e-3);
    let ramp = vec![0.0, 1.0, 2.0];
    let panel = Panel::new(x, y)
        .with(
            Curve::new(text, ramp.clone(), vec![3.0, 1.0, 2.0], Colour::Blue)
                .with_line(Line::DashDot),
        )
        .with(
            Points::new(text, ramp.clone(), ramp.clone(), Colour::Green)
                .with_labels(vec![text.to_owned(); 3]),
        )
        .with(Region::new(text, vec![0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0], Colour::Sky))
        .with(Reference::horizontal(1.5, text, Colour::DANGER))
        .with(Reference::vertical(0.5, text, Colour::DANGER))
        .with(Label::new(1.0, 1.0, text));
    Figure::new(text, text).with_caption(text).with(panel.clone()).with(panel)
}
