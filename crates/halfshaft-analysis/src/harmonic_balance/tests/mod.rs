//! Harmonic balance held against paths that share nothing with it.

mod condensed;
mod derivatives;
mod detached;
mod every_sample;
mod independent;
#[path = "../../../tests/common/lines.rs"]
mod lines;
mod long;
mod over_drive;
mod robust;
mod side_by_side;

use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::{Driveline, Source, read_model};
use halfshaft_numerics::observer::Silent;

use super::answer::Setting;
use super::branches::{Collected, Job};
use super::problem::Axis;
use super::system::Place;
use super::tracer::Counted;

/// All branches of a line with what they were found from.
struct Traced {
    setting: Setting,
    collected: Collected,
}

fn line_of(text: &str) -> Driveline {
    match read_model(Source::new("test.toml", text), &[]) {
        Ok((line, _)) => line,
        Err(found) => panic!("{}\n{text}", found.plain()),
    }
}

fn equations_of(text: &str) -> Rc<EquationsOfMotion> {
    Rc::new(EquationsOfMotion::new(&line_of(text)).expect("is validated"))
}

fn setting_of(text: &str, range: (f64, f64)) -> Setting {
    Setting::new(equations_of(text), Some(range), 1).expect("can be asked")
}

/// Every branch over a range of speeds, as `resonance` finds them.
fn traced(text: &str, range: (f64, f64), tolerance: f64) -> Traced {
    traced_with(setting_of(text, range), tolerance, None)
}

fn traced_with(setting: Setting, tolerance: f64, harmonics: Option<usize>) -> Traced {
    let mut counted = Counted::default();
    let seeds = setting.seeds(harmonics, &Silent, &mut counted);
    let job = Job {
        line: &setting.line,
        axis: Axis::Frequency,
        place: Place { frequency: setting.range.0, drive: 1.0 },
        base: setting.base,
        settings: setting.trace_settings(tolerance, harmonics),
        observer: &Silent,
        doublings: true,
        judged: true,
        stability: halfshaft_model::question::StabilityMethod::Monodromy,
    };
    let collected = job.collect(&seeds);
    Traced { setting, collected }
}
