//! All the questions of a report, with ranges that show what matters.

use halfshaft_analysis::{AnalysisError, ask};
use halfshaft_model::Driveline;
use halfshaft_model::question::{
    FoldsQuestion, ModesQuestion, ParameterRange, Question, ResonanceMethod, ResonanceQuestion,
    ShockQuestion,
};
use halfshaft_numerics::observer::{Observer, Part};
use halfshaft_results::{
    Answer, Header, MissingSection, ModeScaling, Reason, ReportResult, ResonanceResult, Termination,
};

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
        shock: None,
        resonance: None,
        folds: Vec::new(),
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

/// Sections that a report asks for, for its progress.
const SECTIONS: usize = 7;

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
        let shock = ShockQuestion { compare: true, duration: 3.0, ..ShockQuestion::default() };
        if let Some(Answer::History(shock)) = self.ask("shock", &Question::Shock(shock)) {
            self.report.shock = Some(shock);
        }
        let resonance = ResonanceQuestion {
            method: ResonanceMethod::Averaged,
            verify: true,
            ..ResonanceQuestion::default()
        };
        if let Some(Answer::Resonance(resonance)) =
            self.ask("resonance", &Question::Resonance(resonance))
        {
            self.folds(&resonance);
            self.report.resonance = Some(resonance);
        }
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
                    advice: error.advice(),
                });
                None
            }
        }
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
    /// the shaft that measures the mode.
    fn folds(&mut self, resonance: &ResonanceResult) {
        let Some(scaling) = resonance.scaling.first() else { return };
        for parameter in planes(self.line, scaling) {
            let question = FoldsQuestion {
                frequency: None,
                parameter,
                method: ResonanceMethod::Averaged,
                mode: scaling.mode,
                order: Some(scaling.order),
                points: 240,
                harmonics: None,
                tolerance: 1e-6,
            };
            if let Some(Answer::Folds(folds)) = self.ask("folds", &Question::Folds(question)) {
                // A plane without any fold is a finding too; its warning says so.
                self.report.folds.push(folds);
            }
        }
    }
}

/// Parameters and ranges that hold both the model's own value and the cusp, where there is one.
fn planes(line: &Driveline, scaling: &ModeScaling) -> Vec<ParameterRange> {
    let mut planes = Vec::new();
    let mut add = |address: String, from: f64, to: f64| {
        if line.parameter(&address).is_ok() && from < to {
            planes.push(ParameterRange { address, from, to });
        }
    };
    // The excitation scales all amplitudes of its order together only where there is one.
    let loud: Vec<_> = line
        .torques()
        .iter()
        .filter(|torque| torque.harmonics[0].amplitude_nm != 0.0)
        .filter(|torque| torque.harmonics[0].order == scaling.order)
        .collect();
    if let ([torque], Some(factor)) = (loud.as_slice(), scaling.fold_threshold_factor) {
        let own = torque.harmonics[0].amplitude_nm.abs();
        let to = own * (1.6 * factor).max(1.4);
        add(format!("{}.amplitude", torque.name), own * 1e-3, to);
    }
    let shaft = line.shafts().iter().find(|shaft| shaft.name == scaling.shaft);
    if let Some(shaft) = shaft.filter(|shaft| shaft.damping_nm_s_per_rad > 0.0) {
        let own = shaft.damping_nm_s_per_rad;
        let critical = own * critical_damping(scaling) / scaling.beta;
        if critical.is_finite() && critical > 0.0 {
            add(
                format!("{}.damping", shaft.name),
                0.05 * critical,
                (1.6 * critical).max(1.2 * own),
            );
        }
    }
    if let Some(shaft) = shaft.filter(|shaft| shaft.cubic_nm_per_rad3 != 0.0) {
        let own = shaft.cubic_nm_per_rad3;
        let reach = 2.0 * own.abs();
        add(format!("{}.cubic", shaft.name), -reach, reach);
    }
    planes
}

/// Damping coefficient below which the response folds at the model's own excitation:
/// `β_c³ = 9 √3 |α| f²/(32 ω1³)` (theory 5).
fn critical_damping(scaling: &ModeScaling) -> f64 {
    let ModeScaling { alpha, f, omega_1, .. } = scaling;
    (9.0 * 3.0_f64.sqrt() * alpha.abs() * f * f / (32.0 * omega_1.powi(3))).cbrt()
}
