//! Many trajectories at once: initial value problems side by side in the lanes of vector registers,
//! batch by batch on several threads.
//!
//! - [`SeriesSystem`] is what [`by_series`] integrates: equations of motion by Taylor series in time,
//!   through places where the equations change ([`Band`]), which are located to rounding;
//! - [`LaneSystem`] is what [`by_runge_kutta`] integrates: any system `y' = f(t, y)`;
//! - a [`Task`] says what the trajectories are and what is to be learnt from them; each lane has its
//!   own step, and a lane whose trajectory is through takes the next one at once.
//!
//! Results are the same, bit for bit, for any number of threads and lanes and with any instructions:
//! lanes do not see each other, and every lane goes through the same IEEE operations (see [`Lanes`]).
//!
//! | file | task |
//! |---|---|
//! | `lanes`, `functions`, `instructions` | arithmetic on lanes, sines and powers, vector instructions |
//! | `series`, `taylor`, `bands` | Taylor series, their steps, changes of the equations |
//! | `runge_kutta`, `pairs` | Runge-Kutta steps, their coefficients |
//! | `batch`, `stepper`, `task`, `settings` | refilling of lanes, what is asked, numbers |

mod bands;
mod batch;
mod functions;
mod instructions;
mod lanes;
mod pairs;
mod runge_kutta;
mod series;
mod sets;
mod settings;
mod stepper;
mod system;
mod task;
mod taylor;

use std::sync::atomic::AtomicUsize;

pub use bands::{Band, Passage};
pub use functions::{sin_cos, tanh};
pub use instructions::Instructions;
pub use lanes::{Eight, Four, Lanes, One, Sixteen, ThirtyTwo};
pub use pairs::Pair;
pub use series::{LARGEST_DEGREE, RECIPROCALS, cosine_and_sine, product, square, value_and_slope};
pub use sets::{Axis, Varied};
pub use settings::Settings;
pub use system::{Expansion, LaneSystem, Parameters, SeriesSystem};
pub use task::{Finished, Plan, Start, Starts, Task, Trajectory};

use crate::error::{Error, has_length};
use crate::observer::Observer;
use batch::{Batch, Numbered, Shared};
use runge_kutta::RungeKutta;
use stepper::Stepper;
use taylor::Taylor;

/// Runs trajectories 0 to `count - 1` of a task by Taylor series, in order of their numbers;
/// `None` for those that were not finished when the observer cancelled.
///
/// # Errors
///
/// What [`Settings::validate`] finds, and [`Error::Length`] for a system without coordinates.
pub fn by_series<Y: SeriesSystem, T: Task>(
    system: &Y,
    task: &T,
    count: usize,
    settings: &Settings,
    observer: &dyn Observer,
) -> Result<Vec<Option<Finished<T::Memory>>>, Error> {
    let dimension = 2 * system.coordinates();
    run(&Series { system, settings }, dimension, task, count, settings, observer)
}

/// Runs trajectories 0 to `count - 1` of a task by a Runge-Kutta pair, in order of their numbers;
/// `None` for those that were not finished when the observer cancelled.
///
/// # Errors
///
/// What [`Settings::validate`] finds, and [`Error::Length`] for a system of no dimension.
pub fn by_runge_kutta<Y: LaneSystem, T: Task>(
    system: &Y,
    pair: Pair,
    task: &T,
    count: usize,
    settings: &Settings,
    observer: &dyn Observer,
) -> Result<Vec<Option<Finished<T::Memory>>>, Error> {
    let dimension = system.dimension();
    match pair {
        Pair::DormandPrince8 => {
            let method = Stages { system, settings, pair: pairs::Eighth };
            run(&method, dimension, task, count, settings, observer)
        }
        Pair::Tsitouras5 => {
            let method = Stages { system, settings, pair: pairs::Fifth };
            run(&method, dimension, task, count, settings, observer)
        }
    }
}

/// A way to make steppers of any width.
trait Method: Sync {
    fn stepper<L: Lanes>(&self) -> impl Stepper<L>;
}

struct Series<'s, Y> {
    system: &'s Y,
    settings: &'s Settings,
}

impl<Y: SeriesSystem> Method for Series<'_, Y> {
    fn stepper<L: Lanes>(&self) -> impl Stepper<L> {
        Taylor::<Y, L>::new(self.system, self.settings)
    }
}

struct Stages<'s, Y, P> {
    system: &'s Y,
    settings: &'s Settings,
    #[expect(dead_code, reason = "names the type")]
    pair: P,
}

impl<Y: LaneSystem, P: pairs::Coefficients> Method for Stages<'_, Y, P> {
    fn stepper<L: Lanes>(&self) -> impl Stepper<L> {
        RungeKutta::<Y, P, L>::new(self.system, self.settings)
    }
}

fn run<M: Method, T: Task>(
    method: &M,
    dimension: usize,
    task: &T,
    count: usize,
    settings: &Settings,
    observer: &dyn Observer,
) -> Result<Vec<Option<Finished<T::Memory>>>, Error> {
    has_length("state", dimension.max(1), dimension)?;
    settings.validate(dimension)?;
    let shared = Shared {
        task,
        count,
        step_limit: settings.step_limit,
        observer,
        next: AtomicUsize::new(0),
        done: AtomicUsize::new(0),
    };
    let instructions = settings.instructions.unwrap_or_else(Instructions::best);
    let (instructions, lanes) = instructions.for_lanes(settings.lanes.unwrap_or(count));
    let work = || with_lanes(method, &shared, instructions, lanes);
    let threads = threads(settings.threads).min(count.div_ceil(lanes)).max(1);
    let mut out: Vec<Option<Finished<T::Memory>>> = (0..count).map(|_| None).collect();
    let mut sort = |finished: Numbered<T::Memory>| {
        finished.into_iter().for_each(|(index, result)| out[index] = Some(result));
    };
    if threads == 1 {
        sort(work());
        return Ok(out);
    }
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        sort(work());
        for other in others {
            match other.join() {
                Ok(finished) => sort(finished),
                // A task has panicked: so does its caller.
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
    });
    Ok(out)
}

fn threads(wanted: usize) -> usize {
    if wanted > 0 {
        return wanted;
    }
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

fn with_lanes<M: Method, T: Task>(
    method: &M,
    shared: &Shared<'_, T>,
    instructions: Instructions,
    lanes: usize,
) -> Numbered<T::Memory> {
    use Instructions::{Avx2, Avx512, Plain};
    // Each pair is code of its own, so there are no more than serve.
    match (instructions, lanes) {
        (Plain, 1) | (Avx2, 1) => instructions.run(Batch::new(shared, method.stepper::<One>())),
        (Plain | Avx2, 4) => instructions.run(Batch::new(shared, method.stepper::<Four>())),
        (Avx2 | Avx512, 8) => instructions.run(Batch::new(shared, method.stepper::<Eight>())),
        (Avx2 | Avx512, 16) => instructions.run(Batch::new(shared, method.stepper::<Sixteen>())),
        (Avx512, 32) => instructions.run(Batch::new(shared, method.stepper::<ThirtyTwo>())),
        _ => Plain.run(Batch::new(shared, method.stepper::<One>())),
    }
}
