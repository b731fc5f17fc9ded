//! Branches measured: the channels of all samples as columns, special points with their values.

use halfshaft_results::{Branch, Column, Named, SpecialKind, SpecialPoint, Status};

use super::answer::Setting;
use super::branches::TracedBranch;
use super::channels::{ChannelValue, Channels, named, names};
use super::line::Line;
use super::stability::Stability;
use super::system::{HarmonicSystem, Place};
use super::tracer::{BranchEnd, Sample};

/// Measures channels, one set of harmonics at a time.
pub(super) struct Measured<'s> {
    setting: &'s Setting,
    systems: Vec<(HarmonicSystem, Channels)>,
    /// What runs in place of the excitation speed.
    along: Option<Along<'s>>,
}

/// A number of the line that runs along the branches.
#[derive(Clone, Copy)]
pub(super) struct Along<'s> {
    pub(super) address: &'s str,
    pub(super) unit: &'static str,
    pub(super) frequency: f64,
    /// The line at each value.
    pub(super) family: &'s dyn Fn(f64) -> Option<Line>,
}

impl<'s> Measured<'s> {
    pub(super) fn new(setting: &'s Setting, along: Option<Along<'s>>) -> Self {
        Self { setting, systems: Vec::new(), along }
    }

    /// Values of all channels at a sample of a branch over the excitation speed.
    pub(super) fn values(&mut self, sample: &Sample, base: f64, periods: u32) -> Vec<ChannelValue> {
        let same = |(system, channels): &(HarmonicSystem, Channels)| {
            *channels.set() == sample.set && system.base == base
        };
        let at = self.systems.iter().position(same).unwrap_or_else(|| {
            let system = HarmonicSystem::new(self.setting.line.clone(), sample.set.clone(), base);
            self.systems.push((system, Channels::new(&sample.set, periods)));
            self.systems.len() - 1
        });
        let (system, channels) = &mut self.systems[at];
        let mut place = Place { frequency: sample.p, drive: 1.0 };
        if let Some(along) = &self.along {
            place.frequency = along.frequency;
            if let Some(line) = (along.family)(sample.p) {
                system.replace(line);
            }
        }
        channels.measure(system, &sample.u, place)
    }

    /// Speed, and the number that runs in its place, of a sample.
    fn place(&self, sample: &Sample) -> Vec<(String, f64)> {
        let speed = self.along.map_or(sample.p, |along| along.frequency);
        let mut place = vec![("frequency".to_owned(), speed)];
        if let Some(along) = &self.along {
            place.push((along.address.to_owned(), sample.p));
        }
        place
    }

    pub(super) fn branch(&mut self, branch: &TracedBranch) -> Branch {
        let rows: Vec<Vec<ChannelValue>> =
            branch.samples.iter().map(|s| self.values(s, branch.base, branch.periods)).collect();
        let of = |value: &dyn Fn(usize) -> f64| (0..rows.len()).map(value).collect::<Vec<f64>>();
        let mut columns: Vec<Column> = Vec::new();
        let running = branch.samples.iter().map(|sample| sample.p).collect();
        match &self.along {
            None => columns.push(Column::new("frequency".to_owned(), "rad/s", running)),
            Some(along) => {
                let held = vec![along.frequency; rows.len()];
                columns.push(Column::new("frequency".to_owned(), "rad/s", held));
                columns.push(Column::new(along.address.to_owned(), along.unit, running));
            }
        }
        for (index, (name, unit)) in names(&self.setting.line.equations).into_iter().enumerate() {
            let mut add = |word: &str, value: &dyn Fn(&ChannelValue) -> f64| {
                let values = rows.iter().map(|row| value(&row[index])).collect();
                columns.push(Column::new(format!("{name}.{word}"), unit, values));
            };
            add("amplitude", &|v| v.amplitude);
            add("mean", &|v| v.mean);
            add("harmonic1", &|v| v.harmonic1);
        }
        let stability = &branch.stability;
        columns.push(Column::new(
            "stable",
            "1",
            of(&|k| {
                let stable = f64::from(u8::from(stability[k].is_stable()));
                if stability[k].is_known() { stable } else { f64::NAN }
            }),
        ));
        columns.push(Column::new("unstable_dimension", "1", of(&|k| stability[k].unstable as f64)));
        columns.push(Column::new("largest_multiplier", "1", of(&|k| stability[k].largest())));
        columns.push(Column::new(
            "harmonics",
            "1",
            of(&|k| branch.samples[k].set.highest() as f64),
        ));
        columns.push(Column::new("truncation", "1", of(&|k| branch.samples[k].truncation)));
        let mut special_points: Vec<SpecialPoint> = Vec::new();
        special_points.extend(self.end(branch, true));
        special_points.extend(branch.specials.iter().map(|special| self.special(branch, special)));
        special_points.extend(self.end(branch, false));
        Branch {
            columns,
            special_points,
            closed: branch.closed(),
            periods: branch.periods,
            origin: branch.origin.clone(),
            ends: described(branch),
            multipliers: stability.iter().map(leading).collect(),
        }
    }

    fn point(&mut self, branch: &TracedBranch, sample: &Sample) -> Named<f64> {
        let values = self.values(sample, branch.base, branch.periods);
        let mut all: Named<f64> = Named::default();
        all.extend(self.place(sample));
        all.extend(named(&self.setting.line.equations, &values));
        all
    }

    fn special(
        &mut self,
        branch: &TracedBranch,
        special: &super::special::Special,
    ) -> SpecialPoint {
        let mut values = self.point(branch, &special.sample);
        if let Some(stability) = &special.stability {
            values.insert("largest_multiplier".to_owned(), stability.largest());
            if special.kind == SpecialKind::NeimarkSacker {
                values
                    .insert("multiplier_angle".to_owned(), super::stability::pair_angle(stability));
            }
        }
        if special.kind == SpecialKind::PeriodDoubling {
            values.insert("multiplier_angle".to_owned(), std::f64::consts::PI);
        }
        values.insert("harmonics".to_owned(), special.sample.set.highest() as f64);
        if special.precision.is_finite() {
            values.insert("precision".to_owned(), special.precision);
        }
        let status = if special.located { Status::Located } else { Status::Bracketed };
        let mut point = SpecialPoint::new(special.kind, status, values);
        point.unstable_dimension_change = special.change;
        point.note.clone_from(&special.note);
        point
    }

    /// The end of a branch that is not closed and did not begin at another.
    fn end(&mut self, branch: &TracedBranch, first: bool) -> Option<SpecialPoint> {
        let end = branch.ends[usize::from(!first)];
        if branch.closed() || end == BranchEnd::Enough {
            return None;
        }
        let sample = if first { branch.samples.first() } else { branch.samples.last() }?;
        Some(SpecialPoint::new(SpecialKind::End, Status::Located, self.point(branch, sample)))
    }
}

/// Multipliers of each sample that are kept.
const KEPT_MULTIPLIERS: usize = 8;

fn leading(stability: &Stability) -> Vec<[f64; 2]> {
    stability.multipliers.iter().take(KEPT_MULTIPLIERS).map(|m| [m.re, m.im]).collect()
}

fn described(branch: &TracedBranch) -> String {
    let of = |end: BranchEnd| match end {
        BranchEnd::Range => "at the border of the range",
        BranchEnd::Closed => "where it began",
        BranchEnd::StepTooSmall => "where no step was small enough to go on",
        BranchEnd::SampleLimit => "after as many samples as allowed",
        BranchEnd::Unbounded => "where the response grows beyond all measure",
        BranchEnd::Chattering => "where a contact closes and opens too often to be followed",
        BranchEnd::Grazing => "where a twist grazes a break of its law",
        BranchEnd::Cancelled => "where it was stopped",
        BranchEnd::Enough => "where it meets another branch",
    };
    if branch.closed() {
        return "closed".to_owned();
    }
    let [from, to] = branch.ends.map(of);
    if from == to { from.to_owned() } else { format!("{from}, and {to}") }
}
