//! How the parts look: plates, springs, gears, ground, curved arrows.

use super::layout::PLATE;
use crate::figure::Colour;
use crate::figure::scene::{Disc, Fill, Ink, Path, Point, Primitive, Role, Shape, Stroke};

/// Lines of the drawing.
pub(super) const LINE: Ink = (60, 66, 74);
/// The face of a plate.
const FACE: Ink = (214, 228, 240);
/// Lines that only lead from a part to its name.
const LEADER: Ink = (190, 196, 204);
/// Width of lines.
pub(super) const WIDTH: f64 = 1.2;

/// Half of the length of a spring.
const SPRING: f64 = 24.0;
/// Half of its height.
const SPRING_HEIGHT: f64 = 6.5;
/// Teeth of a spring.
const TEETH: usize = 6;
/// Radius of the circles of a gear with ratio 1.
const GEAR: f64 = 7.5;

/// A line through corners.
pub(super) fn line(role: Role, corners: Vec<Point>, stroke: Stroke) -> Primitive {
    let path = Path { runs: vec![corners], closed: false, fill: None, stroke: Some(stroke) };
    Primitive { role, shape: Shape::Path(path) }
}

fn area(role: Role, corners: Vec<Point>, fill: Ink, stroke: Option<Stroke>) -> Primitive {
    let fill = Some(Fill::solid(fill));
    Primitive { role, shape: Shape::Path(Path { runs: vec![corners], closed: true, fill, stroke }) }
}

/// A disc seen from the side.
pub(super) fn plate(centre: Point, half_height: f64) -> Primitive {
    let corner = |x: f64, y: f64| centre.moved(x * PLATE, y * half_height);
    let corners = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    area(Role::Marker, corners, FACE, Some(Stroke::solid(LINE, WIDTH)))
}

/// A node without inertia.
pub(super) fn dot(centre: Point) -> Primitive {
    let disc = Disc { centre, radius: 2.5, fill: Some(Fill::solid(LINE)), stroke: None };
    Primitive { role: Role::Marker, shape: Shape::Disc(disc) }
}

/// The line from a part to its name.
pub(super) fn leader(from: Point, to: f64) -> Primitive {
    let corners = vec![from, Point::new(from.x, to)];
    line(Role::Grid, corners, Stroke::solid(LEADER, 0.6))
}

/// The fixed wall.
pub(super) fn ground(centre: Point) -> Vec<Primitive> {
    let half = 17.0;
    let stroke = || Stroke::solid(LINE, WIDTH);
    let wall = vec![centre.moved(0.0, -half), centre.moved(0.0, half)];
    let strokes = (0..7).map(|index| {
        let y = -half + 4.0 + f64::from(index) * 5.0;
        line(
            Role::Frame,
            vec![centre.moved(0.0, y), centre.moved(7.0, y - 6.0)],
            Stroke::solid(LINE, 0.8),
        )
    });
    std::iter::once(line(Role::Frame, wall, stroke())).chain(strokes).collect()
}

/// A shaft: a zigzag in the middle of its line, crossed by an arrow where it is nonlinear.
pub(super) fn spring(from: Point, to: Point, nonlinear: bool) -> Vec<Primitive> {
    let middle = Point::new(f64::midpoint(from.x, to.x), from.y);
    let ink = if nonlinear { Colour::DANGER.rgb() } else { Colour::PRIMARY.rgb() };
    let half = SPRING.min(0.42 * (to.x - from.x).abs());
    let mut zigzag = vec![middle.moved(-half, 0.0)];
    let step = 2.0 * half / (TEETH as f64 + 1.0);
    for tooth in 0..TEETH {
        let up = if tooth % 2 == 0 { -SPRING_HEIGHT } else { SPRING_HEIGHT };
        zigzag.push(middle.moved(-half + step * (tooth as f64 + 1.0), up));
    }
    zigzag.push(middle.moved(half, 0.0));
    let stroke = Stroke::solid(LINE, WIDTH);
    let mut parts = vec![
        line(Role::Frame, vec![from, middle.moved(-half, 0.0)], stroke.clone()),
        line(Role::Frame, vec![middle.moved(half, 0.0), to], stroke),
        line(Role::Curve, zigzag, Stroke::solid(ink, 1.6)),
    ];
    if nonlinear {
        let (tail, tip) = (middle.moved(-0.62 * half, 11.0), middle.moved(0.62 * half, -10.5));
        parts.push(line(Role::Curve, vec![tail, tip], Stroke::solid(ink, 1.0)));
        parts.push(head(tail, tip, ink));
    }
    parts
}

/// A gear: two circles in mesh, larger where it turns more slowly. `ratio` is the speed on the
/// left over that on the right.
pub(super) fn gear(from: Point, to: Point, ratio: f64) -> Vec<Primitive> {
    let middle = Point::new(f64::midpoint(from.x, to.x), from.y);
    let root = ratio.abs().sqrt();
    let growth = if root.is_finite() { root.clamp(0.7, 1.43) } else { 1.0 };
    let (left, right) = (GEAR / growth, GEAR * growth);
    let start = middle.moved(-left - right, 0.0);
    let circle = |centre: Point, radius: f64| {
        let stroke = Some(Stroke::solid(LINE, WIDTH));
        let disc = Disc { centre, radius, fill: Some(Fill::solid((255, 255, 255))), stroke };
        Primitive { role: Role::Marker, shape: Shape::Disc(disc) }
    };
    let centres = [start.moved(left, 0.0), start.moved(2.0 * left + right, 0.0)];
    let hub = |centre: Point| {
        let disc = Disc { centre, radius: 1.3, fill: Some(Fill::solid(LINE)), stroke: None };
        Primitive { role: Role::Marker, shape: Shape::Disc(disc) }
    };
    let stroke = || Stroke::solid(LINE, WIDTH);
    vec![
        line(Role::Frame, vec![from, start], stroke()),
        line(Role::Frame, vec![start.moved(2.0 * (left + right), 0.0), to], stroke()),
        circle(centres[0], left),
        circle(centres[1], right),
        hub(centres[0]),
        hub(centres[1]),
    ]
}

/// A torque: an arrow round the axis, forward or back.
pub(super) fn torque(centre: Point, forward: bool, ink: Ink) -> Vec<Primitive> {
    let (rx, ry) = (9.0, 7.5);
    let side = if forward { 1.0 } else { -1.0 };
    // From the lower left over the top to the right.
    let corner = |index: u32| {
        let angle = (200.0 - 200.0 * f64::from(index) / 24.0).to_radians();
        centre.moved(side * rx * angle.cos(), -ry * angle.sin())
    };
    let corners: Vec<Point> = (0..=24).map(corner).collect();
    let (before, tip) = (corners[21], corners[24]);
    vec![line(Role::Curve, corners, Stroke::solid(ink, 1.5)), head(before, tip, ink)]
}

/// The head of an arrow at `tip`.
fn head(from: Point, tip: Point, ink: Ink) -> Primitive {
    let length = (tip.x - from.x).hypot(tip.y - from.y).max(1e-9);
    let (x, y) = ((tip.x - from.x) / length, (tip.y - from.y) / length);
    let corner = |back: f64, aside: f64| tip.moved(-back * x - aside * y, -back * y + aside * x);
    area(Role::Marker, vec![corner(-2.0, 0.0), corner(4.5, 2.6), corner(4.5, -2.6)], ink, None)
}

/// A connection that closes a loop: an arc between two nodes, with its middle.
pub(super) fn arc(from: Point, to: Point) -> (Primitive, Point) {
    let distance = (to.x - from.x).hypot(to.y - from.y);
    let rise = (0.3 * distance).clamp(30.0, 70.0);
    let level = (to.y - from.y).abs() < 1.0;
    let (bulge_x, bulge_y) = if level { (0.0, -2.0 * rise) } else { (2.0 * rise, 0.0) };
    let control =
        Point::new(f64::midpoint(from.x, to.x) + bulge_x, f64::midpoint(from.y, to.y) + bulge_y);
    let at = |share: f64| {
        let (a, b, c) = ((1.0 - share).powi(2), 2.0 * share * (1.0 - share), share * share);
        let (x, y) = (a * from.x + b * control.x + c * to.x, a * from.y + b * control.y + c * to.y);
        Point::new(x, y)
    };
    let corners: Vec<Point> = (0..=32).map(|index| at(f64::from(index) / 32.0)).collect();
    let stroke = Stroke { dash: vec![5.0, 2.5], ..Stroke::solid(Colour::PRIMARY.rgb(), WIDTH) };
    (line(Role::Reference, corners, stroke), at(0.5))
}
