//! The build of a line: which factors its equations have, and where each stands among the parameters.

use halfshaft_model::elements::PulseShape;
use halfshaft_numerics::ensemble::Band;

use super::LaneError;
use crate::equations::{Connection, EquationsOfMotion};
use crate::excitation::Source;
use crate::laws::{Piece, Pieces};

/// Numbers of a piece in the table before its coefficients: upper end, origin, damping.
pub(super) const PIECE_HEAD: usize = 3;

/// A connection.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shaft {
    /// The coordinate that is its twist; `None` for one that closes a loop.
    pub(super) coordinate: Option<usize>,
    /// Its share of each coordinate's rate, one parameter each, where it closes a loop.
    pub(super) shares: Vec<(usize, usize)>,
    /// Highest power of its law.
    pub(super) degree: usize,
    /// Whether every piece has odd powers only.
    pub(super) odd: bool,
    /// Number of pieces of its law.
    pub(super) pieces: usize,
    /// First helper series: twist from the piece's origin, torque, partial results.
    pub(super) helper: usize,
    /// Parameters: number of the present piece; its ends from its origin; its origin, its damping, its
    /// coefficients from the constant on.
    pub(super) piece: usize,
    pub(super) ends: [usize; 2],
    pub(super) origin: usize,
    pub(super) damping: usize,
    pub(super) law: usize,
    /// Parameters: the table of all pieces.
    pub(super) table: usize,
    /// Parameters of dry friction, if there is any: its torque, the inverse of its speed.
    pub(super) friction: Option<[usize; 2]>,
}

/// Helper series of dry friction: rate times its power, tangent, slope of the tangent.
const FRICTION_HELPERS: usize = 3;

impl Shaft {
    /// Helper series: twist, torque, the partial results of the law, and friction.
    pub(super) fn helpers(&self) -> usize {
        let friction = if self.friction.is_some() { FRICTION_HELPERS } else { 0 };
        2 + friction + self.law_helpers()
    }

    /// Helper series of the law alone.
    pub(super) fn law_helpers(&self) -> usize {
        match (self.degree, self.odd) {
            (0 | 1, _) => 0,
            (degree, true) => 1 + (degree - 1) / 2,
            (degree, false) => degree - 1,
        }
    }

    /// Length of a piece in the table.
    pub(super) fn stride(&self) -> usize {
        PIECE_HEAD + self.degree + 1
    }
}

/// A cosine among the torques.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tone {
    /// The source that it belongs to.
    pub(super) source: usize,
    /// Which harmonic of it; `None` for its pulse.
    pub(super) harmonic: Option<usize>,
    /// Parameters: speed and phase.
    pub(super) speed: usize,
    pub(super) phase: usize,
    /// First helper series: cosine, sine.
    pub(super) helper: usize,
}

/// What accelerates a coordinate, each with its parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Row {
    /// Constant, and slope over time.
    pub(super) constant: usize,
    pub(super) slope: usize,
    /// Connections.
    pub(super) torques: Vec<(usize, usize)>,
    /// Tones.
    pub(super) tones: Vec<(usize, usize)>,
    /// Rates of coordinates, by dampers to ground.
    pub(super) drags: Vec<(usize, usize)>,
}

/// A line prepared for integration over lanes by [`by_series`](halfshaft_numerics::ensemble::by_series).
#[derive(Clone, Debug, PartialEq)]
pub struct LaneLine {
    pub(super) rows: Vec<Row>,
    pub(super) shafts: Vec<Shaft>,
    pub(super) tones: Vec<Tone>,
    pub(super) bands: Vec<Band>,
    /// The connection of each band.
    pub(super) watched: Vec<usize>,
    pub(super) helpers: usize,
    pub(super) parameters: usize,
}

/// Hands out places.
#[derive(Default)]
struct Places {
    parameters: usize,
    helpers: usize,
}

impl Places {
    fn parameters(&mut self, count: usize) -> usize {
        self.parameters += count;
        self.parameters - count
    }

    fn helpers(&mut self, count: usize) -> usize {
        self.helpers += count;
        self.helpers - count
    }
}

impl LaneLine {
    /// The build of a line.
    pub fn new(equations: &EquationsOfMotion) -> Self {
        let mut places = Places::default();
        let coordinates = equations.groups();
        let mut shafts = Vec::new();
        for (index, connection) in equations.connections.iter().enumerate() {
            shafts.push(shaft(equations, index, connection, &mut places));
        }
        let tones = tones(&equations.excitation.sources, &mut places);
        let rows = rows(equations, &shafts, &tones, &mut places);
        let kinked = (0..shafts.len()).filter(|index| shafts[*index].pieces > 1);
        let watched: Vec<usize> = kinked.collect();
        let band = |index: &usize| {
            let Shaft { helper, ends: [lower, upper], .. } = shafts[*index];
            Band { series: coordinates + helper, lower, upper }
        };
        Self {
            bands: watched.iter().map(band).collect(),
            watched,
            rows,
            shafts,
            tones,
            helpers: places.helpers,
            parameters: places.parameters,
        }
    }

    /// Name-free check that another line has the same build, if with lower powers in its laws.
    pub(super) fn check(&self, other: &EquationsOfMotion) -> Result<(), LaneError> {
        let differ = |what| Err(LaneError::OtherBuild { what });
        let own = Self::new(other);
        if own.rows.len() != self.rows.len() || own.shafts.len() != self.shafts.len() {
            return differ("the number of inertias or connections");
        }
        let places = |line: &Self| -> Vec<_> {
            let place = |shaft: &Shaft| (shaft.coordinate, shaft.pieces, shaft.friction.is_some());
            line.shafts.iter().map(place).collect()
        };
        if places(&own) != places(self) {
            return differ(
                "the places of their connections, the pieces of their laws or dry friction",
            );
        }
        let fits = |(own, all): (&Shaft, &Shaft)| own.degree <= all.degree && (own.odd || !all.odd);
        if !own.shafts.iter().zip(&self.shafts).all(fits) {
            return differ("the powers of their laws");
        }
        let sources = |line: &Self| -> Vec<_> {
            line.tones.iter().map(|tone| (tone.source, tone.harmonic)).collect()
        };
        if sources(&own) != sources(self) {
            return differ("their harmonics or pulses");
        }
        let drags = |line: &Self| line.rows.iter().map(|row| row.drags.len()).sum::<usize>();
        let torques = |line: &Self| line.rows.iter().map(|row| row.torques.len()).sum::<usize>();
        if drags(&own) != drags(self) || torques(&own) != torques(self) {
            return differ("their dampers to ground");
        }
        Ok(())
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.rows.len()
    }

    /// Number of parameters of a trajectory.
    pub fn parameters(&self) -> usize {
        self.parameters
    }

    /// The connection that a band watches, by index into the equations' list.
    pub fn connection(&self, band: usize) -> usize {
        self.watched[band]
    }
}

fn shaft(
    equations: &EquationsOfMotion,
    index: usize,
    connection: &Connection,
    places: &mut Places,
) -> Shaft {
    let pieces = connection.law.pieces();
    let tree = &equations.network.tree;
    let coordinate = tree.iter().position(|edge| edge.shaft == index);
    let degree = pieces.list().iter().map(|piece| piece.torque.degree()).max().unwrap_or(0);
    let loops: Vec<usize> =
        if coordinate.is_none() { (0..equations.groups()).collect() } else { Vec::new() };
    let count = pieces.list().len();
    let mut shaft = Shaft {
        coordinate,
        shares: loops.into_iter().map(|of| (of, places.parameters(1))).collect(),
        degree,
        odd: is_odd(&pieces),
        pieces: count,
        helper: 0,
        piece: places.parameters(1),
        ends: [places.parameters(1), places.parameters(1)],
        origin: places.parameters(1),
        damping: places.parameters(1),
        law: places.parameters(degree + 1),
        table: 0,
        friction: connection.friction.map(|_| [places.parameters(1), places.parameters(1)]),
    };
    shaft.helper = places.helpers(shaft.helpers());
    shaft.table = places.parameters(count * shaft.stride());
    shaft
}

/// Whether all pieces have odd powers of the distance from their origins only.
fn is_odd(pieces: &Pieces) -> bool {
    let odd = |piece: &Piece| piece.torque.coefficients().iter().step_by(2).all(|k| *k == 0.0);
    pieces.list().iter().all(odd)
}

fn tones(sources: &[Source], places: &mut Places) -> Vec<Tone> {
    let mut tones = Vec::new();
    for (source, excitation) in sources.iter().enumerate() {
        let swings = |pulse: &halfshaft_model::elements::Pulse| pulse.shape == PulseShape::HalfSine;
        let pulse = excitation.pulse.as_ref().filter(|pulse| swings(pulse)).map(|_| None);
        for harmonic in (0..excitation.harmonics.len()).map(Some).chain(pulse) {
            tones.push(Tone {
                source,
                harmonic,
                speed: places.parameters(1),
                phase: places.parameters(1),
                helper: places.helpers(2),
            });
        }
    }
    tones
}

fn rows(
    equations: &EquationsOfMotion,
    shafts: &[Shaft],
    tones: &[Tone],
    places: &mut Places,
) -> Vec<Row> {
    let factors = super::values::Factors::new(equations);
    let count = equations.groups();
    let mut rows = Vec::with_capacity(count);
    for row in 0..count {
        // Factors that are zero by the build, not by chance: torques of connections that do not meet.
        let acts = |index: &usize| factors.torque(equations, row, *index) != 0.0;
        let torques: Vec<usize> = (0..shafts.len()).filter(acts).collect();
        let turns = |index: &usize| factors.source(equations, row, tones[*index].source) != 0.0;
        let sounding: Vec<usize> = (0..tones.len()).filter(turns).collect();
        let drags: Vec<usize> =
            (0..count).filter(|of| factors.drag(equations, row, *of) != 0.0).collect();
        let mut placed = |list: Vec<usize>| -> Vec<(usize, usize)> {
            list.into_iter().map(|index| (index, places.parameters(1))).collect()
        };
        let (torques, tones, drags) = (placed(torques), placed(sounding), placed(drags));
        let (constant, slope) = (places.parameters(1), places.parameters(1));
        rows.push(Row { constant, slope, torques, tones, drags });
    }
    rows
}
