//! From the description of a figure to shapes on a page.
//!
//! [`plan`] decides the margins, so that every label has room; [`axes`], [`data`], [`notes`] and
//! [`legend`] draw. Texts between the axes and the legend look for places with little ink, which
//! [`ink`] keeps account of. If the legend finds none, the figure is planned again with the legend
//! below the panel.

use super::font::Weight;
use super::geometry::{Point, Rect};
use super::item::Item;
use super::panel::{Figure, LegendPlace, Panel};
use super::scene::{Align, Fill, Path, Primitive, Role, Scene, Shape, Text};
use super::typeset::Rich;
use ink::InkMap;
use plan::{PanelPlan, Plan};

pub(super) use data::BUDGET;
pub(super) use notes::{NamedPoint, NamedReference};
pub(super) use plan::views;
pub(super) use wrap::wrapped;

pub(super) mod style;

mod axes;
mod data;
mod ink;
mod legend;
mod markers;
mod notes;
mod plan;
#[cfg(test)]
mod tests;
mod wrap;

/// Composes a figure.
#[must_use]
pub fn compose(figure: &Figure) -> Scene {
    let (plan, drawings) = planned_and_drawn(figure);
    let mut primitives = vec![page(&plan)];
    primitives.extend(title(&plan));
    if figure.panels.is_empty() {
        let middle = Point::new(0.5 * plan.width, 0.5 * plan.height);
        primitives.push(empty_remark(middle));
    }
    primitives.extend(drawings.into_iter().flat_map(|drawing| drawing.primitives));
    Scene { width: plan.width, height: plan.height, primitives }
}

/// Where the texts of a panel lie that may choose.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    pub points: Vec<NamedPoint>,
    pub references: Vec<NamedReference>,
}

/// On which sides of the points and lines of each panel their names lie, for a program that places
/// texts by side only.
pub(super) fn sides_of_names(figure: &Figure) -> Vec<Names> {
    let named = |item: &Item| match item {
        Item::Points(points) => !points.labels.is_empty(),
        Item::Reference(reference) => !reference.label.is_empty(),
        _ => false,
    };
    if !figure.panels.iter().flat_map(|panel| &panel.items).any(named) {
        return vec![Names::default(); figure.panels.len()];
    }
    let names =
        |drawing: Drawing| Names { points: drawing.named, references: drawing.named_references };
    planned_and_drawn(figure).1.into_iter().map(names).collect()
}

fn planned_and_drawn(figure: &Figure) -> (Plan, Vec<Drawing>) {
    let mut below: Vec<bool> = figure.panels.iter().map(starts_below).collect();
    let mut plan = Plan::new(figure, &below);
    let mut drawings = draw(figure, &plan);
    let crowded = |(panel, drawing): (&Panel, &Drawing)| {
        panel.legend == LegendPlace::Auto && drawing.legend_lacks_room
    };
    let crowded: Vec<bool> = figure.panels.iter().zip(&drawings).map(crowded).collect();
    if crowded.contains(&true) {
        below.iter_mut().zip(&crowded).for_each(|(below, crowded)| *below |= crowded);
        plan = Plan::new(figure, &below);
        drawings = draw(figure, &plan);
    }
    (plan, drawings)
}

fn starts_below(panel: &Panel) -> bool {
    match panel.legend {
        LegendPlace::Below => true,
        LegendPlace::Auto => legend::is_long(panel),
        LegendPlace::Inside(_) | LegendPlace::Hidden => false,
    }
}

/// One drawn panel.
struct Drawing {
    primitives: Vec<Primitive>,
    named: Vec<NamedPoint>,
    named_references: Vec<NamedReference>,
    legend_lacks_room: bool,
}

fn draw(figure: &Figure, plan: &Plan) -> Vec<Drawing> {
    figure.panels.iter().zip(&plan.panels).map(|(panel, plan)| draw_panel(panel, plan)).collect()
}

fn draw_panel(panel: &Panel, plan: &PanelPlan) -> Drawing {
    let mut canvas = Canvas::new(plan);
    canvas.regions(panel);
    canvas.axes(plan);
    canvas.references(panel);
    canvas.curves(panel);
    canvas.points(panel);
    if !canvas.shows_data {
        canvas.primitives.push(empty_remark(canvas.rect.centre()));
    }
    canvas.notes(panel);
    let legend_lacks_room = !canvas.legend(panel, plan);
    let Canvas { primitives, named, named_references, .. } = canvas;
    Drawing { primitives, named, named_references, legend_lacks_room }
}

/// A panel while it is drawn.
struct Canvas<'a> {
    plan: &'a PanelPlan,
    rect: Rect,
    ink: InkMap,
    primitives: Vec<Primitive>,
    named: Vec<NamedPoint>,
    named_references: Vec<NamedReference>,
    shows_data: bool,
}

impl<'a> Canvas<'a> {
    fn new(plan: &'a PanelPlan) -> Self {
        let rect = plan.rect;
        Self {
            plan,
            rect,
            ink: InkMap::new(rect),
            primitives: Vec::new(),
            named: Vec::new(),
            named_references: Vec::new(),
            shows_data: false,
        }
    }

    fn add(&mut self, role: Role, shape: Shape) {
        self.primitives.push(Primitive { role, shape });
    }

    /// Where a pair of values lies; not finite if it has no place.
    fn place(&self, x: f64, y: f64) -> Point {
        Point::new(
            self.rect.left + self.plan.x.view.share(x) * self.rect.width(),
            self.rect.bottom - self.plan.y.view.share(y) * self.rect.height(),
        )
    }
}

/// The remark that there is nothing to see.
fn empty_remark(place: Point) -> Primitive {
    let text = Text { colour: style::FAINT, ..note("no data to show", place, Align::Middle) };
    Primitive { role: Role::Annotation, shape: Shape::Text(text) }
}

/// A small text of the program's own words.
fn note(words: &str, place: Point, align: Align) -> Text {
    Text {
        rich: Rich::plain(words),
        place,
        align,
        upright: false,
        size: style::NOTE_SIZE,
        weight: Weight::Regular,
        colour: style::TEXT,
        halo: false,
    }
}

fn page(plan: &Plan) -> Primitive {
    let page = Rect { left: 0.0, top: 0.0, right: plan.width, bottom: plan.height };
    let path = Path {
        runs: vec![page.corners()],
        closed: true,
        fill: Some(Fill::solid(style::PAPER)),
        stroke: None,
    };
    Primitive { role: Role::Background, shape: Shape::Path(path) }
}

fn title(plan: &Plan) -> impl Iterator<Item = Primitive> + '_ {
    plan.title.iter().enumerate().map(|(line, rich)| {
        let down = line as f64 * style::TITLE_SIZE * super::font::LINE_HEIGHT;
        let text = Text {
            rich: rich.clone(),
            size: style::TITLE_SIZE,
            weight: Weight::Bold,
            ..note("", plan.title_place.moved(0.0, down), Align::Start)
        };
        Primitive { role: Role::Title, shape: Shape::Text(text) }
    })
}
