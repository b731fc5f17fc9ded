//! The drawing put together.

use halfshaft_results::CheckResult;

use super::caption::{Captions, LEADING, Line, Look};
use super::layout::{self, ABOVE_EDGE, BELOW_EDGE, EDGE, Layout, Run};
use super::symbols;
use crate::figure::Colour;
use crate::figure::scene::{
    Align, Fill, Ink, Path, Point, Primitive, Rich, Role, Scene, Shape, Stroke, Text,
};
use crate::topology::{Network, Part};

/// Letters of values.
const VALUE: Ink = (85, 85, 85);
/// Letters of names.
const NAME: Ink = (26, 26, 26);

/// The line with all that is needed to draw it.
pub(super) struct Drawing<'c> {
    check: &'c CheckResult,
    network: Network,
    loops: Vec<usize>,
    captions: Captions,
    halves: Vec<f64>,
    layout: Layout,
    parts: Vec<Primitive>,
    /// What to say where there is nothing to draw.
    nothing: &'static str,
}

/// More nodes than this are not drawn: nobody could read them.
const MOST: usize = 800;

impl<'c> Drawing<'c> {
    pub(super) fn new(check: &'c CheckResult) -> Self {
        let mut network = Network::new(check);
        let mut nothing = "nothing to draw";
        if network.nodes.len() > MOST {
            (network, nothing) = (Network::default(), "too many parts to draw; see the tables");
        }
        let chains = network.chains();
        let captions = Captions::new(check, &network);
        let layout = layout::lay_out(&network, &chains, &captions);
        let halves = layout::half_heights(&network);
        Self {
            check,
            network,
            loops: chains.loops,
            captions,
            halves,
            layout,
            parts: Vec::new(),
            nothing,
        }
    }

    /// Draws everything.
    pub(super) fn finish(mut self) -> Scene {
        self.arcs();
        for run in std::mem::take(&mut self.layout.runs) {
            self.run(&run);
        }
        for node in 0..self.network.nodes.len() {
            self.node(node);
        }
        if self.network.nodes.is_empty() {
            let line = Line { text: self.nothing.to_owned(), look: Look::Value };
            (self.layout.width, self.layout.height) = (300.0, 50.0);
            self.text(&line, Point::new(150.0, 28.0));
        }
        self.framed()
    }

    /// The page around everything, moved so that arcs above the first row fit in.
    fn framed(self) -> Scene {
        let top = self.parts.iter().map(topmost).fold(EDGE, f64::min);
        let right = self.parts.iter().map(rightmost).fold(0.0, f64::max);
        let down = EDGE - top;
        let (width, height) =
            (self.layout.width.max(right + EDGE), self.layout.height + down + EDGE);
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        let page = Path {
            runs: vec![corners.map(|(x, y)| Point::new(x, y)).to_vec()],
            closed: true,
            fill: Some(Fill::solid((255, 255, 255))),
            stroke: None,
        };
        let page = Primitive { role: Role::Background, shape: Shape::Path(page) };
        let moved = self.parts.into_iter().map(|part| lowered(part, down));
        Scene { width, height, primitives: std::iter::once(page).chain(moved).collect() }
    }

    fn arcs(&mut self) {
        for edge in std::mem::take(&mut self.loops) {
            let ends = self.network.edges[edge];
            let (from, to) = (self.layout.places[ends.from], self.layout.places[ends.to]);
            let (arc, middle) = symbols::arc(from, to);
            self.parts.push(arc);
            let caption = &self.captions.edges[edge];
            let lines: Vec<Line> = caption.above.iter().chain(&caption.below).cloned().collect();
            for (index, line) in lines.iter().enumerate() {
                self.text(line, middle.moved(0.0, LEADING * index as f64 - 2.0));
            }
        }
    }

    fn run(&mut self, run: &Run) {
        let [.., from, to] = run.corners.as_slice() else { return };
        let (from, to) = (*from, *to);
        let lead = run.corners[..run.corners.len() - 1].to_vec();
        self.parts.push(symbols::line(
            Role::Frame,
            lead,
            Stroke::solid(symbols::LINE, symbols::WIDTH),
        ));
        let edge = self.network.edges[run.edge];
        let symbol = match edge.part {
            Part::Shaft(index) => {
                let shaft = self.check.shafts.get(index);
                symbols::spring(from, to, shaft.is_some_and(|s| !s.nonlinear_terms.is_empty()))
            }
            Part::Gear(index) => {
                let ratio = self.check.gears.get(index).map_or(1.0, |gear| gear.ratio);
                let ratio = if edge.from == run.start { ratio } else { 1.0 / ratio };
                symbols::gear(from, to, ratio)
            }
        };
        self.parts.extend(symbol);
        let middle = Point::new(f64::midpoint(from.x, to.x), from.y);
        let caption = self.captions.edges[run.edge].clone();
        let lines = caption.above.len();
        for (index, line) in caption.above.iter().enumerate() {
            let up = ABOVE_EDGE + (lines - 1 - index) as f64 * LEADING;
            self.text(line, middle.moved(0.0, -up));
        }
        for (index, line) in caption.below.iter().enumerate() {
            self.text(line, middle.moved(0.0, BELOW_EDGE + index as f64 * LEADING));
        }
    }

    fn node(&mut self, index: usize) {
        let node = &self.network.nodes[index];
        let (place, half) = (self.layout.places[index], self.halves[index]);
        if node.is_ground {
            self.parts.extend(symbols::ground(place));
            return;
        }
        let (above, text) = (self.layout.text_above[index], self.layout.text_below[index]);
        self.parts.push(symbols::leader(place, text - 9.0));
        self.parts.push(if half < 3.0 { symbols::dot(place) } else { symbols::plate(place, half) });
        let torques: Vec<usize> = node.torques.clone();
        let caption = self.captions.nodes[index].clone();
        if !torques.is_empty() {
            let first = torques.first().and_then(|index| self.check.torques.get(*index));
            let back = first.is_some_and(|torque| torque.mean.is_some_and(|mean| mean < 0.0));
            let centre = place.moved(0.0, -half - 8.0);
            self.parts.extend(symbols::torque(centre, !back, Colour::SAFE.rgb()));
        }
        let lines = caption.above.len();
        for (row, line) in caption.above.iter().enumerate() {
            let up = (lines - 1 - row) as f64 * LEADING;
            self.text(line, Point::new(place.x, above - up));
        }
        for (row, line) in caption.below.iter().enumerate() {
            self.text(line, Point::new(place.x, text + row as f64 * LEADING));
        }
    }

    fn text(&mut self, line: &Line, place: Point) {
        let colour = match line.look {
            Look::Name => NAME,
            Look::Value => VALUE,
            Look::Marked => (178, 70, 0),
            Look::Torque => (0, 110, 80),
        };
        let text = Text {
            rich: Rich::plain(&line.text),
            place,
            align: Align::Middle,
            upright: false,
            size: line.size(),
            weight: line.weight(),
            colour,
            halo: true,
        };
        self.parts.push(Primitive { role: Role::Annotation, shape: Shape::Text(text) });
    }
}

fn topmost(part: &Primitive) -> f64 {
    match &part.shape {
        Shape::Path(path) => path.runs.iter().flatten().map(|p| p.y).fold(f64::INFINITY, f64::min),
        Shape::Disc(disc) => disc.centre.y - disc.radius,
        Shape::Text(text) => text.place.y - text.size,
    }
}

fn rightmost(part: &Primitive) -> f64 {
    match &part.shape {
        Shape::Path(path) => path.runs.iter().flatten().map(|p| p.x).fold(0.0, f64::max),
        Shape::Disc(disc) => disc.centre.x + disc.radius,
        Shape::Text(text) => text.place.x + 0.55 * text.rich.width(text.size, text.weight),
    }
}

fn lowered(mut part: Primitive, down: f64) -> Primitive {
    match &mut part.shape {
        Shape::Path(path) => {
            for point in path.runs.iter_mut().flatten() {
                point.y += down;
            }
        }
        Shape::Disc(disc) => disc.centre.y += down,
        Shape::Text(text) => text.place.y += down,
    }
    part
}
