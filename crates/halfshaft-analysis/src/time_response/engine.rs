//! Which integrator takes the steps: the explicit one of order 8 unless another is asked for, and an implicit
//! one from where the equations turn out stiff.

use halfshaft_dynamics::Motion;
use halfshaft_model::question::IntegratorChoice;
use halfshaft_numerics::Error;
use halfshaft_numerics::ode::dop853::Dop853;
use halfshaft_numerics::ode::dopri5::Dopri5;
use halfshaft_numerics::ode::radau5::Radau5;
use halfshaft_numerics::ode::{OneStep, Settings, Statistics};
use halfshaft_results::IntegratorUse;

/// An integration by one method after another.
pub(super) struct Engine<'l> {
    pub(super) now: Box<dyn OneStep<System = Motion<'l>> + 'l>,
    settings: Settings,
    automatic: bool,
    /// What was used, from when on.
    pub(super) used: Vec<IntegratorUse>,
    /// Work of the methods before.
    before: Statistics,
}

impl<'l> Engine<'l> {
    pub(super) fn new(
        choice: IntegratorChoice,
        motion: Motion<'l>,
        state: &[f64],
        settings: Settings,
    ) -> Result<Self, Error> {
        let now: Box<dyn OneStep<System = Motion<'l>> + 'l> = match choice {
            IntegratorChoice::Automatic | IntegratorChoice::Dop853 => {
                Box::new(Dop853::new(motion, 0.0, state, settings.clone())?)
            }
            IntegratorChoice::Dopri5 => {
                Box::new(Dopri5::new(motion, 0.0, state, settings.clone())?)
            }
            IntegratorChoice::Radau5 => {
                Box::new(Radau5::new(motion, 0.0, state, settings.clone())?)
            }
        };
        let automatic = choice == IntegratorChoice::Automatic;
        let why = if automatic { "the default" } else { "as asked" };
        let used =
            vec![IntegratorUse { method: name(choice).to_owned(), from: 0.0, why: why.to_owned() }];
        Ok(Self { now, settings, automatic, used, before: Statistics::default() })
    }

    /// Goes on implicitly where the steps are held back by stability.
    pub(super) fn adapt(&mut self) -> Result<(), Error> {
        if !(self.automatic && self.now.is_stiff()) {
            return Ok(());
        }
        let (time, state) = (self.now.time(), self.now.state().to_vec());
        let motion = self.now.system().clone();
        let implicit = Radau5::new(motion, time, &state, self.settings.clone())?;
        self.before = self.statistics();
        self.now = Box::new(implicit);
        self.automatic = false;
        self.used.push(IntegratorUse {
            method: name(IntegratorChoice::Radau5).to_owned(),
            from: time,
            why: "the equations are stiff: stability and not accuracy held the steps back"
                .to_owned(),
        });
        Ok(())
    }

    /// Work of all methods together.
    pub(super) fn statistics(&self) -> Statistics {
        let (a, b) = (self.before, self.now.statistics());
        Statistics {
            evaluations: a.evaluations + b.evaluations,
            accepted: a.accepted + b.accepted,
            rejected: a.rejected + b.rejected,
            jacobians: a.jacobians + b.jacobians,
            factorisations: a.factorisations + b.factorisations,
        }
    }
}

fn name(choice: IntegratorChoice) -> &'static str {
    match choice {
        IntegratorChoice::Automatic | IntegratorChoice::Dop853 => "Dormand-Prince 8(5,3)",
        IntegratorChoice::Dopri5 => "Dormand-Prince 5(4)",
        IntegratorChoice::Radau5 => "Radau IIA, order 5, implicit",
    }
}
