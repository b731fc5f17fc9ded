//! Figures without time: wind-up, fold curve, and an axis with large offsets.

use halfshaft_present::figure::{
    Anchor, Axis, Colour, Corner, Curve, Figure, Label, LegendPlace, Line, Marker, Panel, Points,
    Reference, Region, Size, escape,
};

fn grid(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|i| from + (to - from) * f64::from(i) / f64::from(count)).collect()
}

/// A softening shaft: torque over twist, its capacity, and the zones on both sides of it.
pub fn windup() -> Figure {
    let torque = |twist: f64| 420.0 * twist - 190.0 * twist.powi(3);
    let peak = (420.0 / (3.0 * 190.0_f64)).sqrt();
    let capacity = torque(peak);
    let (rising, falling) = (grid(0.0, peak, 200), grid(peak, 1.25, 100));
    let of = |twists: &[f64]| twists.iter().map(|&t| torque(t)).collect::<Vec<f64>>();
    let (rise, fall) = (of(&rising), of(&falling));
    let below = |mut x: Vec<f64>, mut y: Vec<f64>| {
        x.extend([x[x.len() - 1], x[0]]);
        y.extend([0.0, 0.0]);
        (x, y)
    };
    let (safe_x, safe_y) = below(rising.clone(), rise.clone());
    let (unsafe_x, unsafe_y) = below(falling.clone(), fall.clone());
    let panel = Panel::new(Axis::new("Shaft twist θ", "rad"), Axis::new("Torque M", "N·m"))
        .with(Region::new("holds", safe_x, safe_y, Colour::SAFE))
        .with(Region::new("slips through", unsafe_x, unsafe_y, Colour::DANGER))
        .with(Reference::horizontal(
            capacity,
            format!("capacity M_{{max}} = {capacity:.1} N·m"),
            Colour::DANGER,
        ))
        .with(Curve::new("static wind-up", rising, rise, Colour::PRIMARY))
        .with(
            Curve::new("static wind-up", falling, fall, Colour::PRIMARY)
                .with_line(Line::Dashed)
                .unlisted(),
        )
        .with(
            Points::new("limit point", vec![peak], vec![capacity], Colour::DANGER)
                .with_marker(Marker::Diamond)
                .with_labels(vec![format!("θ_{{cr}} = {peak:.3} rad")]),
        )
        .with(Label { anchor: Anchor::Right, ..Label::new(0.13, 40.0, "M = k_1 θ − k_3 θ^3") });
    Figure::new("windup", "Static wind-up of a softening shaft").with(panel)
}

/// The fold set of `x^3 - a x - b = 0`: `b = ± 2 (a/3)^{3/2}`, with its cusp at the origin.
pub fn fold_curve() -> Figure {
    let a = grid(0.0, 3.0, 150);
    let b = |a: f64| 2.0 * (a / 3.0).powf(1.5);
    let upper: Vec<f64> = a.iter().map(|&a| b(a)).collect();
    let lower: Vec<f64> = upper.iter().map(|b| -b).collect();
    let around = |upper: &[f64], lower: &[f64]| {
        let x: Vec<f64> = a.iter().chain(a.iter().rev()).copied().collect();
        (x, upper.iter().chain(lower.iter().rev()).copied().collect::<Vec<f64>>())
    };
    let (zone_x, zone_y) = around(&upper, &lower);
    let panel = Panel::new(
        Axis::new("Static torque M_0/M_{max}", "").with_range(-1.0, 3.0),
        Axis::new("Amplitude of the excitation", "N·m").with_range(-2.5, 2.5),
    )
    .with(Region::new("three responses", zone_x, zone_y, Colour::Sky))
    .with(Curve::new("upper fold", a.clone(), upper, Colour::index(0)))
    .with(Curve::new("lower fold", a, lower, Colour::index(1)).with_line(Line::Dashed))
    .with(
        Points::new("cusp", vec![0.0], vec![0.0], Colour::Black)
            .with_marker(Marker::Star)
            .with_labels(vec!["cusp".to_owned()]),
    )
    .with(
        Points::new(
            "checked in time",
            vec![1.5, 2.5, 0.5, 2.0],
            vec![0.2, -0.6, 1.4, -1.7],
            Colour::Purple,
        )
        .with_marker(Marker::Cross),
    );
    Figure::new("cusp", "Folds meet in a cusp").with_size(Size::Square).with(panel)
}

/// Numbers that need a base, a multiplier, and names that need protection.
pub fn fine_scale() -> Figure {
    let x: Vec<f64> = grid(0.0, 1.0, 50).iter().map(|t| 1.0001 + 1e-4 * t).collect();
    let y: Vec<f64> = x.iter().map(|x| 4.2e6 + 3e-3 * (6e4 * x).sin()).collect();
    let markers = [
        Marker::Circle,
        Marker::Square,
        Marker::Triangle,
        Marker::TriangleDown,
        Marker::Diamond,
        Marker::Cross,
        Marker::Plus,
        Marker::Star,
    ];
    let mut panel = Panel::new(Axis::new("Ratio i", ""), Axis::new("Stiffness k", "N·m/rad"))
        .with(Curve::new(escape("gear_box <b>^{x}"), x.clone(), y.clone(), Colour::Grey));
    for (index, marker) in markers.into_iter().enumerate() {
        let (x, y) = (vec![x[6 * index + 2]], vec![y[6 * index + 2]]);
        let points = Points::new(format!("{marker:?}"), x, y, Colour::index(index));
        let points = points.with_marker(marker).with_labels(vec![format!("{marker:?}")]);
        panel = panel.with(if index % 2 == 0 { points } else { points.hollow() });
    }
    Figure::new(
        "fine",
        "A long heading that has to be broken into more than one line because it says \
        in full what the figure shows, with δ_1^2 and Ω_{max} in it",
    )
    .with_size(Size::Column)
    .with(
        panel.with_legend(LegendPlace::Inside(Corner::BottomRight)).with_legend(LegendPlace::Auto),
    )
}
