//! What the composition promises: everything on the page, curves in their frame, texts apart.

use proptest::collection::vec;
use proptest::prelude::{prop_assert, proptest};

use super::compose;
use crate::figure::geometry::Rect;
use crate::figure::scene::{Align, Path, Role, Scene, Shape, Text};
use crate::figure::{Axis, Colour, Curve, Figure, LegendPlace, Panel, Reference};

fn paths(scene: &Scene, role: Role) -> Vec<&Path> {
    let shapes = scene.primitives.iter().filter(|primitive| primitive.role == role);
    shapes
        .filter_map(|primitive| match &primitive.shape {
            Shape::Path(path) => Some(path),
            _ => None,
        })
        .collect()
}

fn texts(scene: &Scene) -> Vec<(Role, &Text)> {
    scene
        .primitives
        .iter()
        .filter_map(|primitive| match &primitive.shape {
            Shape::Text(text) => Some((primitive.role, text)),
            _ => None,
        })
        .collect()
}

/// The box around a text by the widths of the font.
fn area(text: &Text) -> Rect {
    let width = text.rich.width(text.size, text.weight);
    let before = match text.align {
        Align::Start => 0.0,
        Align::Middle => 0.5 * width,
        Align::End => width,
    };
    let (x, y) = (text.place.x, text.place.y);
    let tall = 0.7 * text.size;
    if text.upright {
        let bottom = y + before;
        Rect { left: x - tall, right: x, top: bottom - width, bottom }
    } else {
        Rect { left: x - before, right: x - before + width, top: y - tall, bottom: y }
    }
}

fn bounds(path: &Path) -> Rect {
    let points = path.runs.iter().flatten();
    let none = Rect { left: f64::MAX, top: f64::MAX, right: f64::MIN, bottom: f64::MIN };
    points.fold(none, |b, p| Rect {
        left: b.left.min(p.x),
        right: b.right.max(p.x),
        top: b.top.min(p.y),
        bottom: b.bottom.max(p.y),
    })
}

fn wave(count: i32, turns: f64) -> Curve {
    let x: Vec<f64> = (0..count).map(|i| f64::from(i) / f64::from(count - 1)).collect();
    let y = x.iter().map(|x| (turns * std::f64::consts::TAU * x).sin()).collect();
    Curve::new("wave", x, y, Colour::Blue)
}

proptest! {
    /// Oracle: the page and the boxes of the texts by the font: all texts lie on the page, and no two
    /// of the axes overlap.
    #[test]
    fn axis_texts_lie_on_the_page_and_apart(
        low in -5.0..5.0_f64, order in -12..12_i32, span in 0.001..3.0_f64,
        words in vec("[A-Za-z]{1,9}", 0..14), panels in 1..4_usize,
    ) {
        let (from, to) = (low * 10f64.powi(order), (low + span) * 10f64.powi(order));
        let label = words.join(" ");
        let axis = || Axis::new(label.clone(), "N·m").with_range(from, to).with_secondary("b", "rpm", 9.55);
        let panel = Panel::new(axis(), axis());
        let mut figure = Figure::new("f", label.clone());
        figure.panels = vec![panel; panels];
        let scene = compose(&figure);
        let page = Rect { left: 0.0, top: 0.0, right: scene.width, bottom: scene.height };
        let boxes: Vec<Rect> = texts(&scene)
            .into_iter()
            .filter(|(role, _)| *role != Role::Annotation)
            .map(|(_, text)| area(text))
            .collect();
        for (index, one) in boxes.iter().enumerate() {
            let whole = one.width() * one.height();
            prop_assert!((one.overlap(&page) - whole).abs() < 1e-6 * whole, "{one:?} off the page");
            for other in &boxes[..index] {
                prop_assert!(one.overlap(other) < 0.5, "{one:?} on {other:?}");
            }
        }
    }
}

/// Oracle: geometry: curves far beyond the shown range stay inside the frame.
#[test]
fn curves_stay_in_their_frame() {
    let axis = || Axis::default().with_range(-0.3, 0.3);
    let panel = Panel::new(axis(), axis()).with(wave(5000, 30.0));
    let scene = compose(&Figure::new("f", "").with(panel));
    let frame = bounds(paths(&scene, Role::Frame)[0]);
    let curve = bounds(paths(&scene, Role::Curve)[0]);
    let inside = frame.grown(1e-9);
    assert!(curve.left >= inside.left && curve.right <= inside.right);
    assert!(curve.top >= inside.top && curve.bottom <= inside.bottom);
}

/// Oracle: two situations with a known answer: a rising line leaves the upper left corner free; a
/// dense wave leaves nothing free, so the legend goes below the frame.
#[test]
fn the_legend_covers_nothing_where_it_can() {
    let legend = |curve: Curve| {
        let panel = Panel::new(Axis::default(), Axis::default()).with(curve);
        let scene = compose(&Figure::new("f", "").with(panel));
        let frame = bounds(paths(&scene, Role::Frame)[0]);
        let name = texts(&scene).into_iter().find(|(role, _)| *role == Role::Legend);
        (area(name.unwrap().1), frame)
    };
    let rising = Curve::new("rising", vec![0.0, 1.0, 1.0], vec![0.0, 1.0, 0.0], Colour::Blue);
    let (name, frame) = legend(rising);
    assert!(name.right < frame.centre().x && name.bottom < frame.centre().y);
    let (name, frame) = legend(wave(5000, 200.0));
    assert!(name.top > frame.bottom);
}

/// Oracle: the stated effort: every point of a curve is looked at, and the scene holds no more corners
/// than the budget allows, however long the curve.
#[test]
fn the_size_of_a_scene_does_not_follow_the_size_of_the_data() {
    let corners = |count: i32| {
        let panel = Panel::new(Axis::default(), Axis::default())
            .with(wave(count, 3000.0))
            .with_legend(LegendPlace::Hidden);
        compose(&Figure::new("f", "").with(panel)).corners()
    };
    assert!(corners(1_000_000) < super::BUDGET + 2000);
    assert!(corners(1_000_000) < 2 * corners(100_000));
}

/// Oracle: the rule for shared axes: equal horizontal axes, one set of numbers and one text.
#[test]
fn stacked_panels_share_their_axis() {
    let panel = |to: f64| {
        let curve = Curve::new("c", vec![0.0, to], vec![0.0, 1.0], Colour::Blue);
        Panel::new(Axis::new("Time", "s"), Axis::new("y", "m")).with(curve)
    };
    let scene = compose(&Figure::new("f", "").with(panel(1.0)).with(panel(4.0)));
    let named = |words: &str| texts(&scene).iter().filter(|t| t.1.rich.text() == words).count();
    assert_eq!((named("Time (s)"), named("y (m)"), named("4.0")), (1, 2, 1));
    let curves = paths(&scene, Role::Curve);
    let (upper, lower) = (bounds(curves[0]), bounds(curves[1]));
    let frame = bounds(paths(&scene, Role::Frame)[0]);
    assert!((upper.width() - 0.25 * frame.width()).abs() < 0.1);
    assert!((lower.width() - frame.width()).abs() < 0.1 && lower.top > upper.bottom);
}

/// Oracle: the definition of a reference line, and the rule that the range includes it.
#[test]
fn reference_lines_cross_the_whole_panel() {
    let panel = Panel::new(Axis::default(), Axis::default())
        .with(wave(50, 1.0))
        .with(Reference::horizontal(3.0, "limit", Colour::DANGER));
    let scene = compose(&Figure::new("f", "").with(panel));
    let frame = bounds(paths(&scene, Role::Frame)[0]);
    let line = bounds(paths(&scene, Role::Reference)[0]);
    assert_eq!((line.left, line.right), (frame.left, frame.right));
    assert!(line.top > frame.top && line.top < frame.centre().y);
    let name = texts(&scene).into_iter().find(|(role, _)| *role == Role::Annotation).unwrap().1;
    assert!(area(name).bottom < line.top);
}
