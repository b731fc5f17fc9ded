//! The figures that a study describes.

use halfshaft_results::{
    Answer, Column, FoldsResult, ItemStyle, ModeScaling, ResonanceResult, SpecialPoint,
    StudyFigureSpec, StudyItem, StudyResult,
};

use super::axes::{column_axis, name};
use super::{detuned, folds, resonance, slug};
use crate::account::check::minus;
use crate::account::folds::cusp_points;
use crate::account::resonance::fold_points;
use crate::figure::{
    Axis, Colour, Curve, Figure, Item, Line, Marker, Panel, Points, Region, escape,
};
use crate::words::{number, plain};

/// The id of the figure of that name.
pub(crate) fn id(name: &str) -> String {
    slug(name)
}

/// The figures of a study, in file order, under their own names.
#[must_use]
pub fn study_figures(study: &StudyResult) -> Vec<Figure> {
    super::with_unique_ids(study.figures.iter().map(|spec| figure(study, spec)).collect())
}

fn figure(study: &StudyResult, spec: &StudyFigureSpec) -> Figure {
    let items: Vec<(&StudyItem, &Answer)> = study
        .items
        .iter()
        .filter(|item| item.figure.as_ref() == Some(&spec.name) && item.style != ItemStyle::Hidden)
        .filter_map(|item| Some((item, item.answer.as_ref()?)))
        .collect();
    let mut panel =
        Panel::new(axis(&items, &spec.x, spec.x_range), axis(&items, &spec.y, spec.y_range));
    let scaling = items.iter().find_map(|(_, answer)| detuned::scaling(answer));
    let mut colours = 0;
    let mut drawn = Vec::new();
    let mut known: Vec<&str> = Vec::new();
    for (item, answer) in &items {
        let beside = known.iter().find_map(|name| second_of(item, answer, name));
        // All of a second method look alike; each lies beside the first that it belongs to.
        let colour = beside.map_or_else(|| Colour::index(colours), |_| Colour::Black);
        let drawing = Drawing { spec, item, colour, scaling, beside };
        let items = drawing.items(&detuned::completed(answer, scaling));
        colours += usize::from(beside.is_none() && !items.is_empty());
        known.push(&item.question);
        drawn.extend(items);
    }
    // The legend names the curves first, then the kinds of points.
    drawn.sort_by_key(|item| matches!(item, Item::Points(_)));
    panel = panel.with_all(drawn);
    Figure::new(id(&spec.name), escape(&plain(&spec.title)))
        .with_caption(escape(&plain(&spec.caption)))
        .with(panel)
}

/// The name of the method of a question that asks for periodic responses as another one does, by a
/// second method: "harmonic balance" of "f = 5, harmonic balance" beside "f = 5".
fn second_of<'s>(item: &'s StudyItem, answer: &Answer, name: &str) -> Option<&'s str> {
    let periodic = matches!(answer, Answer::Resonance(_) | Answer::Folds(_));
    let second = periodic && item.style == ItemStyle::Second;
    item.question.strip_prefix(name)?.strip_prefix(", ").filter(|_| second)
}

/// The axis of a column, with the unit that the first answer gives it.
fn axis(items: &[(&StudyItem, &Answer)], column: &str, range: Option<(f64, f64)>) -> Axis {
    let unit = items
        .iter()
        .flat_map(|(_, answer)| tables(answer))
        .find_map(|table| table.find(column).map(|column| column.unit.clone()));
    let mut axis = column_axis(column, &unit.unwrap_or_default());
    axis.range = range;
    axis
}

/// Columns of equal length that a curve may come from.
struct Columns<'a> {
    /// The shaft whose channels the columns are, where their names do not say so.
    shaft: Option<&'a str>,
    columns: &'a [Column],
}

impl<'a> Columns<'a> {
    fn find(&self, name: &str) -> Option<&'a Column> {
        let name = match self.shaft {
            Some(shaft) => name.strip_prefix(shaft)?.strip_prefix('.')?,
            None => name,
        };
        self.columns.iter().find(|column| column.name == name)
    }
}

/// All columns of an answer that a curve may come from.
fn tables(answer: &Answer) -> Vec<Columns<'_>> {
    match answer {
        Answer::History(result) => {
            let compared = result.shock.iter().filter_map(|s| s.comparison_history.as_ref());
            let compared = compared.map(|table| Columns { shaft: None, columns: &table.columns });
            std::iter::once(Columns { shaft: None, columns: &result.columns })
                .chain(compared)
                .collect()
        }
        Answer::Resonance(result) => {
            result.branches.iter().map(|b| Columns { shaft: None, columns: &b.columns }).collect()
        }
        Answer::Folds(result) => {
            result.curves.iter().map(|c| Columns { shaft: None, columns: &c.columns }).collect()
        }
        Answer::Static(result) => result
            .curves
            .iter()
            .map(|(shaft, table)| Columns { shaft: Some(shaft), columns: &table.columns })
            .collect(),
        Answer::Forced(result) => result
            .gears
            .iter()
            .map(|gear| Columns { shaft: None, columns: &gear.table.columns })
            .collect(),
        Answer::Check(_)
        | Answer::Modes(_)
        | Answer::Campbell(_)
        | Answer::Basins(_)
        | Answer::Bifurcation(_)
        | Answer::Study(_)
        | Answer::Report(_) => Vec::new(),
    }
}

/// One answer in a figure.
struct Drawing<'s> {
    spec: &'s StudyFigureSpec,
    item: &'s StudyItem,
    colour: Colour,
    /// The scaling of the figure's closed form.
    scaling: Option<&'s ModeScaling>,
    /// The method, where the question is that of another one by a second method.
    beside: Option<&'s str>,
}

impl Drawing<'_> {
    fn items(&self, answer: &Answer) -> Vec<Item> {
        match answer {
            Answer::Resonance(result) => self.responses(result),
            Answer::Folds(result) => self.fold_curves(answer, result),
            _ => self.curves(answer),
        }
    }

    fn label(&self) -> String {
        name(&minus(self.beside.unwrap_or(&self.item.question)))
    }

    /// A curve for each of the answer's tables that has both columns.
    fn curves(&self, answer: &Answer) -> Vec<Item> {
        let curve = |table: &Columns<'_>| {
            let (x, y) = (table.find(&self.spec.x)?, table.find(&self.spec.y)?);
            let curve = Curve::new(self.label(), x.values.clone(), y.values.clone(), self.colour);
            Some(Item::from(self.styled(curve)))
        };
        tables(answer).iter().filter_map(curve).collect()
    }

    fn styled(&self, curve: Curve) -> Curve {
        match self.item.style {
            ItemStyle::Second if self.beside.is_some() => {
                curve.with_line(Line::DashDot).with_width(1.0)
            }
            ItemStyle::Second => curve.with_line(Line::DashDot),
            ItemStyle::Line | ItemStyle::Hidden => curve,
        }
    }

    fn responses(&self, result: &ResonanceResult) -> Vec<Item> {
        let (x, y) = (&self.spec.x, &self.spec.y);
        let mut items: Vec<Item> = Vec::new();
        for branch in &result.branches {
            let curves = resonance::branch_curves(branch, x, y, &self.label(), self.colour);
            items.extend(curves.into_iter().filter(|curve| !curve.x.is_empty()).map(|curve| {
                // Dashes keep their meaning; a second method is told from stable lines only.
                let stable = curve.line == Line::Solid;
                Item::from(if stable { self.styled(curve) } else { curve })
            }));
        }
        items.extend(self.marked(&fold_points(&result.branches), "fold", Marker::Circle));
        if self.shows_reference_twist(result) {
            items.extend(resonance::verified(result, self.scaling, x));
        }
        items
    }

    /// Whether the vertical axis shows what verification measures.
    fn shows_reference_twist(&self, result: &ResonanceResult) -> bool {
        let channel = result.leading_channel();
        let twist = |measure: &str| {
            channel.as_ref().is_some_and(|channel| self.spec.y == format!("{channel}.{measure}"))
        };
        self.spec.y == "rho" || twist("harmonic1") || twist("amplitude")
    }

    fn fold_curves(&self, answer: &Answer, result: &FoldsResult) -> Vec<Item> {
        let mut items = self.curves(answer);
        if self.spec.y == result.parameter && self.item.style == ItemStyle::Line {
            items.splice(0..0, self.areas(&items));
        }
        let cusps: Vec<&SpecialPoint> = cusp_points(result).collect();
        items.extend(self.marked(&cusps, "cusp", Marker::Star));
        items
    }

    /// What lies between the folds.
    fn areas(&self, curves: &[Item]) -> Vec<Item> {
        let lines: Vec<(Vec<f64>, Vec<f64>)> = curves
            .iter()
            .filter_map(|item| match item {
                Item::Curve(curve) => Some((curve.x.clone(), curve.y.clone())),
                _ => None,
            })
            .collect();
        let region = |(x, y)| Region::new("between the folds", x, y, Colour::Sky).into();
        folds::areas(&lines).into_iter().map(region).collect()
    }

    /// Special points in the colour of danger, with the value that tells of them.
    fn marked(&self, points: &[&SpecialPoint], kind: &str, marker: Marker) -> Option<Item> {
        let (x, y) = (&self.spec.x, &self.spec.y);
        let places: Vec<(f64, f64)> =
            points.iter().filter_map(|point| Some((point.value(x)?, point.value(y)?))).collect();
        if places.is_empty() {
            return None;
        }
        // A fold is told by its speed, a cusp by the parameter.
        let told = |place: &(f64, f64)| if marker == Marker::Star { place.1 } else { place.0 };
        let labels = places.iter().map(|place| number(told(place), 5)).collect();
        let (xs, ys) = places.into_iter().unzip();
        let points = Points::new(kind, xs, ys, Colour::DANGER).with_marker(marker);
        // Those of a second method lie beside the first's, which are named.
        Some(match self.item.style {
            ItemStyle::Second => {
                let colour = if self.beside.is_some() { Colour::Black } else { points.colour };
                Points { size: 4.0, colour, ..points }.unlisted().into()
            }
            ItemStyle::Line | ItemStyle::Hidden => points.with_labels(labels).into(),
        })
    }
}
