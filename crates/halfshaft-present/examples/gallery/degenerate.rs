//! Inputs that carry no picture, or too much of one.

use halfshaft_present::figure::{
    Axis, Colour, Curve, Figure, Panel, Points, Reference, Region, Size,
};

/// One figure for each kind of trouble.
pub fn figures() -> Vec<Figure> {
    let figure =
        |(id, panel): (&str, Panel)| Figure::new(id, id).with_size(Size::Column).with(panel);
    let mut figures: Vec<Figure> = values().into_iter().map(figure).collect();
    figures.push(figure(("strange-names", strange_names())));
    figures.push(Figure::new("no-panels", "no panels"));
    figures
}

fn panel() -> Panel {
    Panel::new(Axis::new("x", "m"), Axis::new("y", "s^{-1}"))
}

/// Too few values, or values that are no numbers.
fn values() -> Vec<(&'static str, Panel)> {
    let nan = f64::NAN;
    let curve = |x: &[f64], y: &[f64]| {
        panel().with(Curve::new("curve", x.to_vec(), y.to_vec(), Colour::PRIMARY))
    };
    vec![
        ("empty", panel()),
        ("one-point", curve(&[3.0], &[4.0])),
        ("constant", curve(&[0.0, 1.0, 2.0], &[5.0; 3])),
        ("gaps", curve(&[0.0, 1.0, nan, 2.0, 3.0, 4.0], &[0.0, 1.0, 5.0, 1.0, nan, f64::INFINITY])),
        ("huge", curve(&[-1e300, 0.0, 1e300], &[-1e300, 1e299, 1e300])),
        ("nothing-finite", curve(&[nan; 4], &[1.0; 4])),
    ]
}

/// Names that other formats would act on, and letters that the font lacks.
fn strange_names() -> Panel {
    let name = "<script>alert(\"&\")</script> $x$ 漢字 🚗 \u{7} ñ _{";
    panel()
        .with(Points::new(name, vec![1.0, 2.0], vec![1.0, 2.0], Colour::index(1)))
        .with(Region::new("line", vec![0.0, 1.0], vec![0.0, 1.0], Colour::SAFE))
        .with(Reference::vertical(1.5, "%{x} ]]> & <sub>", Colour::DANGER))
}
