//! What is told of a stepwise sweep: where the motion repeats, where not, where it jumps.

use halfshaft_results::{BifurcationResult, SweepJump};

use super::{Account, Grid};
use crate::words::{capital, column_label, counted, list, number, plain, quantity};

/// Stretches that are told in words at most; a table has the rest.
const MOST_TOLD: usize = 6;
/// Rows of that table at most.
const MOST_ROWS: usize = 40;

/// The whole account.
pub(crate) fn account(result: &BifurcationResult) -> Account {
    let mut account = Account::default();
    let stretches = stretches(result);
    account.text(opening(result));
    for (direction, way) in [(1.0, "up"), (-1.0, "down")] {
        let own: Vec<&Stretch> = stretches.iter().filter(|s| s.direction == direction).collect();
        account.text(told(result, way, &own));
    }
    account.text(jumps(result));
    account.text(matched(result));
    account.figure(crate::figures::bifurcation::ID);
    account.grid(table(result, &stretches));
    if stretches.iter().any(|stretch| stretch.largest > 0.0 && stretch.kind == Kind::Wandering) {
        account.note(
            "A positive Lyapunov exponent says that neighbouring motions part like e to the exponent times \
             the time: the motion is chaotic. One of zero (to the precision that the recorded time allows) \
             speaks for a quasi-periodic motion.",
        );
    }
    account
}

/// What a motion does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Repeating(u32),
    Wandering,
    Escaped,
    Lost,
}

/// Neighbouring values of one direction at which the motion does the same.
struct Stretch {
    direction: f64,
    kind: Kind,
    /// Swept number at the first and the last value, in the order of the sweep.
    ends: (f64, f64),
    values: usize,
    /// Largest exponent, and where.
    largest: f64,
    at: f64,
    /// Least and greatest amplitude.
    amplitude: (f64, f64),
}

fn stretches(result: &BifurcationResult) -> Vec<Stretch> {
    let columns =
        [&result.swept, "direction", "period", "lyapunov_exponent", "amplitude", "escaped"];
    let [swept, direction, period, exponent, amplitude, escaped] =
        columns.map(|name| result.values.values(name));
    let of = |column: &[f64], row: usize| column.get(row).copied().unwrap_or(f64::NAN);
    let mut all: Vec<Stretch> = Vec::new();
    for (row, value) in swept.iter().enumerate() {
        let kind = kind(of(period, row), of(escaped, row));
        let direction = of(direction, row);
        let continues = |last: &&mut Stretch| last.kind == kind && last.direction == direction;
        let (exponent, amplitude) = (of(exponent, row), of(amplitude, row));
        match all.last_mut().filter(continues) {
            Some(last) => last.add(*value, exponent, amplitude),
            None => all.push(Stretch {
                direction,
                kind,
                ends: (*value, *value),
                values: 1,
                largest: exponent,
                at: *value,
                amplitude: (amplitude, amplitude),
            }),
        }
    }
    all
}

fn kind(period: f64, escaped: f64) -> Kind {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 16")]
    match period {
        _ if escaped == 1.0 => Kind::Escaped,
        p if p >= 1.0 => Kind::Repeating(p as u32),
        p if p.is_nan() => Kind::Lost,
        _ => Kind::Wandering,
    }
}

impl Stretch {
    fn add(&mut self, value: f64, exponent: f64, amplitude: f64) {
        self.ends.1 = value;
        self.values += 1;
        if exponent > self.largest {
            (self.largest, self.at) = (exponent, value);
        }
        self.amplitude = (self.amplitude.0.min(amplitude), self.amplitude.1.max(amplitude));
    }

    /// What the motion does, in words.
    fn words(&self) -> String {
        match self.kind {
            Kind::Repeating(period) => format!("period {period}"),
            Kind::Wandering => "no repetition".to_owned(),
            Kind::Escaped => "runs away".to_owned(),
            Kind::Lost => "could not be followed".to_owned(),
        }
    }
}

/// The unit of the swept number.
fn unit(result: &BifurcationResult) -> &str {
    result.columns.first().map_or("", |column| column.unit.as_str())
}

fn value(result: &BifurcationResult, x: f64) -> String {
    quantity(x, 6, &plain(unit(result)))
}

fn opening(result: &BifurcationResult) -> Vec<String> {
    let swept = result.values.values(&result.swept);
    let (Some(first), Some(last)) =
        (swept.iter().copied().reduce(f64::min), swept.iter().copied().reduce(f64::max))
    else {
        return vec!["No value was reached.".to_owned()];
    };
    let at = result
        .frequency
        .map_or_else(String::new, |speed| format!(" at {}", quantity(speed, 6, "rad/s")));
    vec![format!(
        "The motion of the {} was followed over {}{at} from {} to {}, {} in all.",
        plain(&result.shaft),
        column_label(&result.swept),
        value(result, first),
        value(result, last),
        counted(swept.len(), "motion", "motions")
    )]
}

fn told(result: &BifurcationResult, way: &str, own: &[&Stretch]) -> Vec<String> {
    if own.is_empty() {
        return Vec::new();
    }
    let mut parts: Vec<String> = own
        .iter()
        .take(MOST_TOLD)
        .map(|stretch| {
            let ends = stretch.ends;
            let words = stretch.words();
            if stretch.values == 1 {
                return format!("{words} at {}", value(result, ends.0));
            }
            format!("{words} from {} to {}", value(result, ends.0), value(result, ends.1))
        })
        .collect();
    if own.len() > MOST_TOLD {
        parts.push(format!("and {} more stretches", own.len() - MOST_TOLD));
    }
    let most = own.iter().filter(|s| s.largest.is_finite());
    let most = most.max_by(|a, b| a.largest.total_cmp(&b.largest));
    let mut sentences = vec![format!("Sweeping {way}: {}.", parts.join(", "))];
    sentences.extend(most.map(|stretch| {
        let exponent = quantity(stretch.largest, 4, "1/s");
        format!("Largest Lyapunov exponent {exponent} at {}.", value(result, stretch.at))
    }));
    sentences
}

/// The jumps, where they are few: about chaos there are many, and the figure shows them.
fn jumps(result: &BifurcationResult) -> Vec<String> {
    let mut sentences: Vec<String> =
        result.jumps.iter().take(MOST_TOLD).map(|jump| jumped(result, jump)).collect();
    if result.jumps.len() > MOST_TOLD {
        sentences.push(format!("It jumps {} times more.", result.jumps.len() - MOST_TOLD));
    }
    sentences
}

fn jumped(result: &BifurcationResult, jump: &SweepJump) -> String {
    format!(
        "Sweeping {}, the twist jumps between {} and {} from ±{} to ±{}.",
        if jump.direction > 0.0 { "up" } else { "down" },
        value(result, jump.last),
        value(result, jump.first),
        number(jump.before, 4),
        quantity(jump.after, 4, "rad")
    )
}

/// How many motions lie on continued branches.
fn matched(result: &BifurcationResult) -> Vec<String> {
    if result.branches.is_empty() {
        return Vec::new();
    }
    let periods = result.values.values("period");
    let on = result.values.values("matches_branch");
    let repeating = periods.iter().filter(|period| **period >= 1.0).count();
    let matching = on.iter().filter(|index| index.is_finite()).count();
    let mut missing: Vec<String> = periods
        .iter()
        .zip(on)
        .filter(|(period, index)| **period >= 1.0 && index.is_nan())
        .map(|(period, _)| format!("period {period}"))
        .collect();
    missing.sort();
    missing.dedup();
    let mut text = format!(
        "Of {} that repeat {matching} lie on a branch of resonance",
        counted(repeating, "motion", "motions")
    );
    if !missing.is_empty() {
        text += &format!(
            "; the others, of {}, are still settling or on a response that it does not list",
            list(&missing)
        );
    }
    vec![text + "."]
}

fn table(result: &BifurcationResult, stretches: &[Stretch]) -> Grid {
    let shown = &stretches[..stretches.len().min(MOST_ROWS)];
    let name = capital(&column_label(&result.swept));
    let unit = unit(result);
    let title = if shown.len() < stretches.len() {
        format!("The first {} of {} stretches", shown.len(), stretches.len())
    } else {
        format!("{name}, stretch by stretch")
    };
    Grid::new(title)
        .words("sweep", shown.iter().map(|s| if s.direction > 0.0 { "up" } else { "down" }))
        .numbers("from", unit, 6, shown.iter().map(|s| Some(s.ends.0)))
        .numbers("to", unit, 6, shown.iter().map(|s| Some(s.ends.1)))
        .words("motion", shown.iter().map(Stretch::words))
        .numbers("largest exponent", "1/s", 4, shown.iter().map(|s| Some(s.largest)))
        .numbers("amplitude from", "rad", 4, shown.iter().map(|s| Some(s.amplitude.0)))
        .numbers("to", "rad", 4, shown.iter().map(|s| Some(s.amplitude.1)))
}
