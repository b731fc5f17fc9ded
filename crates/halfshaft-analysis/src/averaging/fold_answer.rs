//! From a line to the answer of `folds --method averaged`.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{FoldsQuestion, ParameterRange, Question};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{
    Column, FoldsResult, Reason, SpecialKind, SpecialPoint, Status, Table, Termination,
};

use super::answer::MOST_DETUNED;
use super::columns::ChannelMaps;
use super::fold_curves::{FoldCurves, FoldPoint, FoldTracer};
use super::mode_equation::ModeEquation;
use super::responses::SlowFlow;
use super::scaling::scaling;
use crate::equilibrium;
use crate::error::AnalysisError;
use crate::header::header;
use crate::modal::{choose_equilibrium, mode_label};

/// A line and its mode; `None` where the line has no stable state.
type Member = Option<Rc<(EquationsOfMotion, ModeEquation)>>;

/// The mode of a line at any value of a parameter.
struct Family<'q> {
    line: &'q Driveline,
    question: &'q FoldsQuestion,
    order: f64,
    target: Target,
    /// The mode at the model's own values.
    base: (EquationsOfMotion, ModeEquation),
    /// Members that have been made, by the bits of the value: each slice is asked for again when
    /// its channels are worked out.
    made: RefCell<HashMap<u64, Member>>,
}

/// What the parameter is.
enum Target {
    /// A number of the model.
    Model(halfshaft_model::Parameter),
    /// A coefficient of the mode's own equation.
    Coefficient(Coefficient),
}

#[derive(Clone, Copy)]
enum Coefficient {
    Alpha,
    Beta,
    F,
    Omega,
}

/// Answers `folds` by averaging.
pub(crate) fn solve(
    line: &Driveline,
    question: &FoldsQuestion,
    observer: &dyn Observer,
) -> Result<FoldsResult, AnalysisError> {
    let family = Family::new(line, question)?;
    let ParameterRange { from, to, .. } = question.parameter;
    let flow = |parameter: f64| family.slow_flow(parameter);
    let (least, most) = family.window();
    let shown = (family.base.1.sigma(least), family.base.1.sigma(most));
    let tracer = FoldTracer { flow: &flow, shown, points: question.points };
    let traced = tracer.trace(from, to, observer)?;
    let mut result = family.result(&traced)?;
    if observer.cancelled() {
        let detail = "not the whole range of the parameter was gone through".to_owned();
        result.header.termination = Termination::early(Reason::Cancelled, detail);
    }
    Ok(result)
}

impl<'q> Family<'q> {
    fn new(line: &'q Driveline, question: &'q FoldsQuestion) -> Result<Self, AnalysisError> {
        let equations = EquationsOfMotion::new(line)?;
        let states = equilibrium::find_stable(&equations)?;
        let rest = choose_equilibrium(line, &equations, &states, None)?;
        let target = match question.parameter.address.as_str() {
            "mode.alpha" => Target::Coefficient(Coefficient::Alpha),
            "mode.beta" => Target::Coefficient(Coefficient::Beta),
            "mode.f" => Target::Coefficient(Coefficient::F),
            "mode.omega_1" => Target::Coefficient(Coefficient::Omega),
            address => Target::Model(
                line.parameter(address).map_err(halfshaft_model::ChangeError::Address)?,
            ),
        };
        let order = match (question.order, &target) {
            (Some(order), _) => Some(order),
            // The amplitude of a torque bends the response of its own order.
            (None, Target::Model(parameter)) => match order_of(line, parameter, question)? {
                Some(order) => Some(order),
                None => strongest(&equations, rest, question.mode)?,
            },
            (None, Target::Coefficient(_)) => strongest(&equations, rest, question.mode)?,
        };
        let order = order.ok_or_else(|| AnalysisError::NoExcitation {
            reason: "no torque has an amplitude".to_owned(),
        })?;
        let base = ModeEquation::new(&equations, rest, question.mode, order)?;
        let made = RefCell::default();
        Ok(Self { line, question, order, target, base: (equations, base), made })
    }

    /// The mode at a value of the parameter.
    fn at(&self, value: f64) -> Result<Member, AnalysisError> {
        if let Some(member) = self.made.borrow().get(&value.to_bits()) {
            return Ok(member.clone());
        }
        let member = self.make(value)?.map(Rc::new);
        self.made.borrow_mut().insert(value.to_bits(), member.clone());
        Ok(member)
    }

    fn make(&self, value: f64) -> Result<Option<(EquationsOfMotion, ModeEquation)>, AnalysisError> {
        let parameter = match &self.target {
            Target::Model(parameter) => parameter,
            Target::Coefficient(coefficient) => {
                let (equations, base) = &self.base;
                let changed = coefficient.set(base, value);
                return Ok(changed.map(|mode| (equations.clone(), mode)));
            }
        };
        let Ok(line) = self.line.with(parameter, value) else { return Ok(None) };
        let equations = EquationsOfMotion::new(&line)?;
        let states = equilibrium::find_stable(&equations)?;
        let Some(rest) = states.primary() else { return Ok(None) };
        match ModeEquation::new(&equations, rest, self.question.mode, self.order) {
            Ok(mode) => Ok(Some((equations, mode))),
            Err(AnalysisError::NotAveraged { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn slow_flow(&self, value: f64) -> Result<Option<SlowFlow>, AnalysisError> {
        if let Target::Coefficient(coefficient) = &self.target {
            return Ok(coefficient.set(&self.base.1, value).map(|mode| mode.slow_flow()));
        }
        Ok(self.at(value)?.map(|member| member.1.slow_flow()))
    }

    fn unit(&self) -> &'static str {
        match &self.target {
            Target::Model(parameter) => parameter.unit(),
            Target::Coefficient(Coefficient::Alpha) => "1/(rad² s²)",
            Target::Coefficient(Coefficient::Beta) => "1/s",
            Target::Coefficient(Coefficient::F) => "rad/s²",
            Target::Coefficient(Coefficient::Omega) => "rad/s",
        }
    }

    fn own_value(&self) -> Option<f64> {
        match &self.target {
            Target::Model(parameter) => parameter.value(self.line),
            Target::Coefficient(coefficient) => Some(coefficient.get(&self.base.1)),
        }
    }

    fn result(&self, traced: &FoldCurves) -> Result<FoldsResult, AnalysisError> {
        let (low, high) = self.window();
        let inside = |frequency: f64| low <= frequency && frequency <= high;
        let mut curves = Vec::new();
        let mut outside: Option<(f64, f64)> = None;
        for curve in &traced.curves {
            let rows = curve.iter().map(|point| self.row(point)).collect::<Result<Vec<_>, _>>()?;
            for frequency in rows.iter().flatten().map(|row| row[0]).filter(|f| !inside(*f)) {
                let (least, most) = outside.unwrap_or((frequency, frequency));
                outside = Some((least.min(frequency), most.max(frequency)));
            }
            let rows: Vec<Option<Vec<f64>>> =
                rows.into_iter().map(|row| row.filter(|row| inside(row[0]))).collect();
            curves.extend(self.tables(&rows));
        }
        let mut special_points = Vec::new();
        for cusp in &traced.cusps {
            let names = self.names();
            if let Some(row) = self.row(cusp)?.filter(|row| inside(row[0])) {
                let values = names.into_iter().map(|(name, _)| name).zip(row).collect();
                special_points.push(SpecialPoint::new(SpecialKind::Cusp, Status::Located, values));
            }
        }
        let mut header = header(self.line, &Question::Folds(self.question.clone()));
        self.say(traced, curves.is_empty(), outside, &mut header);
        let (equations, mode) = &self.base;
        let states = equilibrium::find_stable(equations)?;
        let rest = choose_equilibrium(self.line, equations, &states, None)?;
        let label = mode_label(equations, rest, self.question.mode)?;
        Ok(FoldsResult {
            header,
            curves,
            special_points,
            parameter: self.question.parameter.address.clone(),
            parameter_unit: self.unit().to_owned(),
            parameter_value: self.own_value(),
            scaling: Some(scaling(equations, mode, label)),
            responses: None,
        })
    }

    /// Range of Ω that is shown: what was asked for, or all that averaging can speak of.
    fn window(&self) -> (f64, f64) {
        let least = (1.0 - MOST_DETUNED) * self.base.1.frequency(0.0);
        self.question.frequency.unwrap_or((least, f64::INFINITY))
    }

    fn say(
        &self,
        traced: &FoldCurves,
        nothing: bool,
        outside: Option<(f64, f64)>,
        header: &mut halfshaft_results::Header,
    ) {
        let ParameterRange { address, from, to } = &self.question.parameter;
        header
            .assumptions
            .push("folds of the averaged response of one mode near its resonance".to_owned());
        match (outside, self.question.frequency) {
            (Some((least, most)), Some((from, to))) if nothing => header.warnings.push(format!(
                "no fold between {from:.6} and {to:.6} rad/s, but folds at excitation speeds from \
                 {least:.6} to {most:.6} rad/s"
            )),
            (Some(_), None) => header.assumptions.push(format!(
                "folds below {:.4} rad/s are left out: so far from the natural frequency averaging \
                 does not speak",
                self.window().0
            )),
            _ => {}
        }
        if nothing && outside.is_none() {
            let threshold = self.base.1.slow_flow().threshold();
            let hint = threshold.map_or_else(String::new, |(drive, _)| {
                format!(
                    "; at the model's own values the response folds from f = {:.6} rad/s² on, and the \
                     model has f = {:.6}",
                    2.0 * self.base.1.omega * drive,
                    self.base.1.f
                )
            });
            let unit = if self.unit() == "1" { String::new() } else { format!(" {}", self.unit()) };
            header.warnings.push(format!("no fold for {address} from {from} to {to}{unit}{hint}"));
        }
        if traced.gaps > 0 {
            header.warnings.push(format!(
                "at {} of the sampled values of {address} the line has no stable state, so the curves \
                 end there",
                traced.gaps
            ));
        }
    }

    /// Names and units of the columns of a curve.
    fn names(&self) -> Vec<(String, String)> {
        let (equations, mode) = &self.base;
        let maps = ChannelMaps::new(equations, mode);
        let mut names = vec![
            ("frequency".to_owned(), "rad/s".to_owned()),
            (self.question.parameter.address.clone(), self.unit().to_owned()),
        ];
        let shown = maps.harmonic_names().filter(|(name, _)| self.shows(name));
        names.extend(shown.map(|(name, unit)| (name, unit.to_owned())));
        names.push(("sigma".to_owned(), "rad/s".to_owned()));
        names.push(("rho".to_owned(), "rad".to_owned()));
        names
    }

    /// Whether a channel has a meaning: a restoring coefficient of the scaled equation that is
    /// changed by itself has no shaft whose torque could be told.
    fn shows(&self, channel: &str) -> bool {
        let restoring =
            matches!(self.target, Target::Coefficient(Coefficient::Alpha | Coefficient::Omega));
        !(restoring && channel.contains(".torque."))
    }

    /// Values of a fold in the order of the names; `None` where the mode cannot be had.
    fn row(&self, point: &FoldPoint) -> Result<Option<Vec<f64>>, AnalysisError> {
        let Some(member) = self.at(point.parameter)? else { return Ok(None) };
        let (equations, mode) = &*member;
        let maps = ChannelMaps::new(equations, mode);
        let mut row = vec![mode.frequency(point.response.sigma), point.parameter];
        let values = maps.harmonic_names().zip(maps.harmonic_values(mode, &point.response));
        row.extend(values.filter(|((name, _), _)| self.shows(name)).map(|(_, value)| value));
        row.extend([point.response.sigma, point.response.rho()]);
        Ok(Some(row))
    }

    /// Runs of rows inside the window as tables.
    fn tables(&self, rows: &[Option<Vec<f64>>]) -> Vec<Table> {
        rows.split(Option::is_none)
            .filter(|run| run.len() > 1)
            .map(|run| {
                let columns = self.names().into_iter().enumerate().map(|(index, (name, unit))| {
                    let values = run.iter().flatten().map(|row| row[index]).collect();
                    Column::new(name, unit, values)
                });
                Table::new(columns.collect())
            })
            .collect()
    }
}

impl Coefficient {
    fn get(self, mode: &ModeEquation) -> f64 {
        match self {
            Self::Alpha => mode.alpha(),
            Self::Beta => mode.beta,
            Self::F => mode.f,
            Self::Omega => mode.omega,
        }
    }

    /// The mode with another coefficient; `None` where the value is not allowed.
    fn set(self, base: &ModeEquation, value: f64) -> Option<ModeEquation> {
        let mut mode = base.clone();
        match self {
            // The effective cubic coefficient is set through the plain one.
            Self::Alpha => mode.restoring[3] += value - base.alpha(),
            Self::Beta if value >= 0.0 => mode.beta = value,
            Self::F if value >= 0.0 => mode.f = value,
            Self::Omega if value > 0.0 => {
                let quadratic = base.alpha() - base.restoring[3];
                mode.omega = value;
                mode.restoring[1] = value * value;
                // Keep the effective cubic coefficient, which depends on the frequency.
                mode.restoring[3] += quadratic - (mode.alpha() - mode.restoring[3]);
            }
            _ => return None,
        }
        Some(mode)
    }
}

/// The order that drives the mode most; `None` where no torque has an amplitude.
fn strongest(
    equations: &EquationsOfMotion,
    rest: &equilibrium::RestState,
    mode: usize,
) -> Result<Option<f64>, AnalysisError> {
    // Of equals the lowest order.
    let most = drives(equations, rest, mode)?
        .into_iter()
        .reduce(|best, next| if next.1 > best.1 { next } else { best });
    Ok(most.map(|(order, _)| order))
}

/// The order of which a parameter changes the excitation most over its range; `None` where it
/// changes none.
fn order_of(
    line: &Driveline,
    parameter: &halfshaft_model::Parameter,
    question: &FoldsQuestion,
) -> Result<Option<f64>, AnalysisError> {
    if !question.parameter.address.ends_with("amplitude") {
        return Ok(None);
    }
    let at = |value: f64| -> Result<Vec<(f64, f64)>, AnalysisError> {
        let Ok(line) = line.with(parameter, value) else { return Ok(Vec::new()) };
        let equations = EquationsOfMotion::new(&line)?;
        let states = equilibrium::find_stable(&equations)?;
        states.primary().map_or(Ok(Vec::new()), |rest| drives(&equations, rest, question.mode))
    };
    let without = at(0.0)?;
    let gained = at(question.parameter.to)?.into_iter().map(|(order, f)| {
        let before = without.iter().find(|(other, _)| *other == order).map_or(0.0, |(_, f)| *f);
        (order, (f - before).abs())
    });
    let most = gained.max_by(|a, b| a.1.total_cmp(&b.1));
    Ok(most.filter(|(_, gain)| *gain > 0.0).map(|(order, _)| order))
}

/// Every order with the amplitude of the excitation that it gives the mode.
fn drives(
    equations: &EquationsOfMotion,
    rest: &equilibrium::RestState,
    mode: usize,
) -> Result<Vec<(f64, f64)>, AnalysisError> {
    let orders = equations.excitation.orders().into_iter();
    orders.map(|order| Ok((order, ModeEquation::new(equations, rest, mode, order)?.f))).collect()
}
