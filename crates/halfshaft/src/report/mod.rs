//! All the questions of a report, with ranges that show what matters.

use halfshaft_analysis::{AnalysisError, ask};
use halfshaft_model::Driveline;
use halfshaft_model::question::{
    BasinsQuestion, CampbellQuestion, FoldsQuestion, ForcedQuestion, ModesQuestion, ParameterRange,
    Question, ResonanceMethod, ResonanceQuestion, ShockQuestion,
};
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_results::{
    Answer, FoldsResult, Header, MissingSection, Reason, ReportResult, ResonanceResult, Termination,
};

mod coexisting;
mod levels;
mod planes;

/// Asks everything that a report tells about a line.
///
/// # Errors
/// [`AnalysisError`] where even the check of the line fails; any other section that cannot be
/// had is listed with its reason.
pub fn report(line: &Driveline, observer: &dyn Observer) -> Result<ReportResult, AnalysisError> {
    let Answer::Check(check) = ask(line, &Question::Check, observer)? else {
        return Err(AnalysisError::NoDisturbance); // cannot be: a question has its own answer
    };
    let mut report = ReportResult {
        header: Header { analysis: "report".to_owned(), ..check.header.clone() },
        check,
        statics: None,
        modes: None,
        campbell: None,
        forced: None,
        shock: None,
        resonance: None,
        first_harmonic: None,
        closed_form: None,
        basins: None,
        levels: Vec::new(),
        folds: Vec::new(),
        closed_folds: Vec::new(),
        missing: Vec::new(),
    };
    let mut reporter = Reporter { line, observer, report: &mut report, done: 0 };
    reporter.ask_all();
    Ok(report)
}

struct Reporter<'r> {
    line: &'r Driveline,
    observer: &'r dyn Observer,
    report: &'r mut ReportResult,
    done: usize,
}

/// Sections that a report asks for, for its progress: statics, modes, critical speeds, forced
/// vibration, shock, three methods of the
/// resonance, basins, and the fold planes by two methods.
const SECTIONS: usize = 15;

/// Twists and rates of the picture of basins: fine enough for the eye.
const BASIN_SIDE: usize = 120;
/// Relative tolerance of the motions in it.
const BASIN_TOLERANCE: f64 = 1e-6;

/// Degrees of freedom beyond which a report leaves motions out, which would take it minutes.
const LONG: usize = 100;
/// The same for a line whose laws are all linear, where they say little more than its modes.
const LONG_LINEAR: usize = 40;

/// Error of the waveform that is tolerated along fold curves: it is not seen in a figure.
const FOLD_TOLERANCE: f64 = 1e-4;

impl Reporter<'_> {
    fn ask_all(&mut self) {
        if let Some(Answer::Static(statics)) = self.ask("static", &Question::Static) {
            self.report.statics = Some(statics);
        }
        if let Some(Answer::Modes(modes)) =
            self.ask("modes", &Question::Modes(ModesQuestion::default()))
        {
            self.report.modes = Some(modes);
        }
        self.linear();
        if self.leaves_motions_out() {
            return;
        }
        let shock = ShockQuestion { compare: true, duration: 3.0, ..ShockQuestion::default() };
        if let Some(Answer::History(shock)) = self.ask("shock", &Question::Shock(shock)) {
            self.report.shock = Some(shock);
        }
        self.report.resonance = self.resonance("resonance", ResonanceMethod::HarmonicBalance);
        self.report.first_harmonic =
            self.resonance("first-harmonic", ResonanceMethod::FirstHarmonic);
        self.report.closed_form = self.resonance("closed-form", ResonanceMethod::Averaged);
        self.say_once();
        self.basins();
        self.folds();
        if !self.observer.cancelled() {
            self.report.levels = levels::levels(self.line, self.report, self.observer);
        }
    }

    /// Tells what is left out of the report of a line too long for it, and whether it is.
    fn leaves_motions_out(&mut self) -> bool {
        let check = &self.report.check;
        let freedom = check.degrees_of_freedom;
        let linear = check.shafts.iter().all(|shaft| shaft.nonlinear_terms.is_empty())
            && check.gears.iter().all(|gear| gear.mesh.is_none_or(|mesh| mesh.clearance == 0.0));
        let most = if linear { LONG_LINEAR } else { LONG };
        if freedom <= most {
            return false;
        }
        let reason = if linear {
            format!(
                "the line is linear and has {freedom} degrees of freedom: see its forced vibration"
            )
        } else {
            format!("motions of {freedom} degrees of freedom take long")
        };
        for (section, command) in [("shock", "shock"), ("resonance", "resonance")] {
            self.report.missing.push(MissingSection {
                section: section.to_owned(),
                reason: reason.clone(),
                advice: Some(format!("ask `halfshaft {command}` by itself")),
            });
        }
        true
    }

    /// Critical speeds and linear vibration, where something of the model follows a speed.
    fn linear(&mut self) {
        let driven = self
            .line
            .torques()
            .iter()
            .any(|torque| torque.harmonics.iter().any(|harmonic| harmonic.amplitude_nm != 0.0));
        let driven = driven || !self.line.engines().is_empty();
        // Without modes there is no equilibrium to vibrate about, which has been told.
        if self.report.modes.is_none() || (!driven && self.line.whole().operating_rad_s.is_none()) {
            return;
        }
        // A report is about the gear that the model is in; its modes are told gear by gear.
        let campbell = CampbellQuestion { this_gear: true, ..CampbellQuestion::default() };
        if let Some(Answer::Campbell(campbell)) =
            self.ask("campbell", &Question::Campbell(campbell))
        {
            self.report.campbell = Some(campbell);
        }
        if !driven {
            return;
        }
        let forced = ForcedQuestion { this_gear: true, ..ForcedQuestion::default() };
        if let Some(Answer::Forced(forced)) = self.ask("forced", &Question::Forced(forced)) {
            self.report.forced = Some(forced);
        }
    }

    fn resonance(&mut self, section: &str, method: ResonanceMethod) -> Option<ResonanceResult> {
        let question = ResonanceQuestion {
            method,
            // One harmonic is held against harmonic balance.
            verify: method != ResonanceMethod::FirstHarmonic,
            backbone: method == ResonanceMethod::HarmonicBalance,
            ..ResonanceQuestion::default()
        };
        let Answer::Resonance(resonance) = self.ask(section, &Question::Resonance(question))?
        else {
            return None;
        };
        if resonance.branches.is_empty() {
            self.report.missing.push(MissingSection {
                section: section.to_owned(),
                reason: "no periodic response was found".to_owned(),
                advice: None,
            });
            return None;
        }
        Some(resonance)
    }

    /// Which start leads where, amid the speeds at which more than one response is stable.
    fn basins(&mut self) {
        let branches =
            self.report.resonance.as_ref().map(|resonance| resonance.branches.as_slice());
        let Some(frequency) = branches.and_then(coexisting::speed) else { return };
        let question = BasinsQuestion {
            frequency,
            grid: (BASIN_SIDE, BASIN_SIDE),
            tolerance: BASIN_TOLERANCE,
            ..BasinsQuestion::default()
        };
        if let Some(Answer::Basins(basins)) = self.ask("basins", &Question::Basins(question)) {
            self.report.basins = Some(basins);
        }
    }

    /// Where no method has a resonance, that is told once: for the reason of other sections if it is
    /// one of theirs. That a method does not fit the line tells less than why another one failed.
    fn say_once(&mut self) {
        if self.report.best_resonance().is_some() {
            return;
        }
        const METHODS: [&str; 3] = ["resonance", "first-harmonic", "closed-form"];
        let missing = &mut self.report.missing;
        let methods = || missing.iter().filter(|one| METHODS.contains(&one.section.as_str()));
        let of_others = |one: &&MissingSection| {
            let mut others = missing.iter().filter(|o| !METHODS.contains(&o.section.as_str()));
            others.any(|other| other.reason == one.reason)
        };
        let telling = |one: &&MissingSection| !one.reason.contains("does not fit this line");
        let told = methods().find(of_others).or_else(|| methods().find(telling));
        let Some(told) = told.or_else(|| methods().next()).cloned() else { return };
        missing.retain(|one| !METHODS.contains(&one.section.as_str()));
        missing.push(MissingSection { section: METHODS[0].to_owned(), ..told });
    }

    /// One answer; where there is none the reason is noted.
    fn ask(&mut self, section: &str, question: &Question) -> Option<Answer> {
        if self.stopped(section) {
            return None;
        }
        let part = Part::of(self.observer, self.done, SECTIONS);
        part.progress(0.0);
        self.done += 1;
        match ask(self.line, question, &part) {
            Ok(answer) => {
                self.heed(answer.header());
                Some(answer)
            }
            Err(error) => {
                self.report.missing.push(MissingSection {
                    section: section.to_owned(),
                    reason: error.to_string(),
                    advice: self.advice(&error),
                });
                None
            }
        }
    }

    /// What to try, by the names of the line that is asked about.
    fn advice(&self, error: &AnalysisError) -> Option<String> {
        let advice = error.advice()?;
        let shaft = self.line.connection_names().next().unwrap_or("SHAFT");
        Some(match error {
            AnalysisError::NoDisturbance => format!(
                "give a torque of the model a pulse, or ask `halfshaft shock --initial \
                 \"{shaft}.twist=1 rad\"`"
            ),
            _ => advice,
        })
    }

    /// Whether the user has stopped the report; then what is missing says so.
    fn stopped(&mut self, section: &str) -> bool {
        if !self.observer.cancelled() {
            return false;
        }
        let termination = &mut self.report.header.termination;
        if termination.is_complete() {
            let detail = format!("stopped by the user before the section {section}");
            *termination = Termination::early(Reason::Cancelled, detail);
        }
        if !self.report.missing.iter().any(|missing| missing.section == section) {
            self.report.missing.push(MissingSection {
                section: section.to_owned(),
                reason: "stopped by the user".to_owned(),
                advice: None,
            });
        }
        true
    }

    /// Takes over that a section ended early because the user stopped it.
    fn heed(&mut self, header: &Header) {
        if header.termination.reason == Reason::Cancelled
            && self.report.header.termination.is_complete()
        {
            self.report.header.termination = header.termination.clone();
        }
    }

    /// Fold curves over the amplitude of the excitation, the damping and the cubic stiffness of
    /// the shaft that swings most, by harmonic balance and in closed form.
    fn folds(&mut self) {
        let closed = self.report.closed_form.as_ref().and_then(|form| form.scaling.first());
        let closed = closed.cloned();
        for parameter in planes::planes(self.line, self.report) {
            let beside = closed.as_ref().and_then(|scaling| {
                let own = (scaling.mode, Some(scaling.order));
                self.plane(question(&parameter, None, ResonanceMethod::Averaged, own))
            });
            if self.report.resonance.is_some() {
                let plane = beside.as_ref().zip(closed.as_ref());
                let speeds = plane.and_then(|(plane, scaling)| planes::speeds(plane, scaling));
                let balance = ResonanceMethod::HarmonicBalance;
                // A plane without any fold is a finding too; its warning says so.
                let folds = self.plane(question(&parameter, speeds, balance, (1, None)));
                self.report.folds.extend(folds);
            }
            self.report.closed_folds.extend(beside);
        }
    }

    fn plane(&mut self, question: FoldsQuestion) -> Option<FoldsResult> {
        match self.ask("folds", &Question::Folds(question))? {
            Answer::Folds(folds) => Some(folds),
            _ => None,
        }
    }
}

/// Fold curves over a parameter, of a mode and an order where the method is of one.
fn question(
    parameter: &ParameterRange,
    frequency: Option<(f64, f64)>,
    method: ResonanceMethod,
    (mode, order): (usize, Option<f64>),
) -> FoldsQuestion {
    FoldsQuestion {
        frequency,
        parameter: parameter.clone(),
        method,
        mode,
        order,
        points: 240,
        harmonics: None,
        tolerance: FOLD_TOLERANCE,
    }
}
