//! The plain text: it holds the numbers of the answer, and fits its terminal.

use halfshaft::model::embedded;
use halfshaft::present::summary::{WIDTH, text};
use halfshaft::results::StaticResult;
use halfshaft::{Answer, Question, Silent, ask};

use super::common::by_hand::{self, DEMAND};
use super::common::{
    EMBEDDED, HARDENING, OVERLOADED, SCALED, answers, assert_shows, flat, line, number_after,
    renamed, the_report, written,
};

/// Columns of a terminal: two for the wide letters of East Asia.
pub fn columns(line: &str) -> usize {
    let wide =
        |c: char| ('\u{1100}'..='\u{115f}').contains(&c) || ('\u{2e80}'..='\u{fe6f}').contains(&c);
    line.chars().map(|c| if wide(c) { 2 } else { 1 }).sum()
}

/// The numbers of the row of a table that begins with these words.
fn row<'t>(text: &'t str, table: &str, start: &str) -> Vec<&'t str> {
    let after = &text[text.find(table).unwrap_or_else(|| panic!("no table {table} in\n{text}"))..];
    let line = after.lines().find(|line| line.trim_start().starts_with(start));
    let line = line.unwrap_or_else(|| panic!("no row {start} in\n{after}"));
    line.trim_start()[start.len()..].split_whitespace().collect()
}

/// The text from a phrase on.
fn from<'t>(text: &'t str, phrase: &str) -> &'t str {
    &text[text.find(phrase).unwrap_or_else(|| panic!("no {phrase} in\n{text}"))..]
}

fn value(cell: &str) -> f64 {
    number_after(cell, "")
}

// Source: the answers themselves, and statics by hand: each verb's key numbers, taken back from the
// text, to the digits shown.
#[test]
fn every_summary_tells_the_numbers_of_its_answer() {
    let mut seen = 0;
    for answer in answers(&line(embedded::example(), &[])) {
        let shown = text(&answer);
        let told = flat(&shown);
        seen += 1;
        match &answer {
            Answer::Check(check) => {
                let cells = row(&shown, "Shafts", "half-shaft");
                let numbers: Vec<f64> =
                    cells[cells.len() - 5..cells.len() - 3].iter().map(|c| value(c)).collect();
                assert_eq!(
                    numbers,
                    [check.shafts[0].stiffness, check.shafts[0].damping],
                    "{cells:?}"
                );
                assert!(told.contains("two degrees of freedom") && check.degrees_of_freedom == 2);
            }
            Answer::Static(result) => statics(result, &told),
            Answer::Modes(result) => {
                let mode = &result.modes[1];
                assert_shows(number_after(&told, "The lowest stands at"), mode.frequency, 5);
                let cells = row(&shown, "  Mode ", "1 ");
                assert_shows(value(cells[0]), mode.frequency, 6);
                assert_shows(value(cells[1]), mode.frequency / std::f64::consts::TAU, 5);
                assert_shows(value(cells[3]), mode.damped_frequency, 6);
                assert_shows(value(cells[4]), mode.damping_ratio, 4);
            }
            Answer::Campbell(result) => {
                let critical = &result.gears[0].critical[0];
                let cells = row(&shown, "Critical speeds in", "");
                assert!(told.contains("is run from 50 to 400 rpm"), "{told}");
                assert!(shown.contains(&cells[0].to_owned()) && critical.mode == 1);
                let strongest = result.gears.iter().flat_map(|gear| &gear.critical);
                let strongest = strongest.filter(|speed| speed.margin.is_some_and(|m| m < 0.2));
                let torque = strongest.filter_map(|speed| speed.torque).fold(0.0, f64::max);
                assert_shows(number_after(&told, "loads the half-shaft with ±"), torque, 4);
            }
            Answer::Forced(result) => {
                let peaks = result.gears.iter().flat_map(|gear| &gear.peaks);
                let torques = peaks.filter(|peak| peak.unit == "N·m").map(|peak| peak.amplitude);
                let largest = torques.fold(0.0, f64::max);
                assert_shows(number_after(&told, "vibratory torque is ±"), largest, 4);
            }
            Answer::History(result) => match &result.shock {
                Some(_) => {
                    let shaft = &result.metrics.shafts["half-shaft"];
                    assert_shows(
                        number_after(&told, "first turns round"),
                        shaft.first_peak_time.expect("turns"),
                        4,
                    );
                    assert_shows(
                        number_after(&told, "after the start,"),
                        shaft.first_peak.expect("turns"),
                        5,
                    );
                    assert_shows(number_after(&told, "half-shaft peaks at"), shaft.peak_torque, 6);
                    let factor = shaft.dynamic_factor.unwrap();
                    assert_shows(
                        number_after(from(&told, "half-shaft peaks at"), " s: "),
                        factor,
                        3,
                    );
                    assert_shows(
                        number_after(&told, "It rings at"),
                        shaft.oscillation_frequency.unwrap(),
                        5,
                    );
                    for method in &result.shock.as_ref().unwrap().comparison {
                        let cells = row(
                            &shown,
                            "What each method answers",
                            &format!("{}  ", method.method),
                        );
                        assert_shows(value(cells[0]), method.first_peak.expect("turns"), 5);
                    }
                }
                None => {
                    let torque = &result.metrics.channels["half-shaft.torque"];
                    assert_shows(number_after(&told, "largest shaft torque is"), torque.maximum, 6);
                    let cells = row(&shown, "Extremes", "half-shaft twist ");
                    let twist = &result.metrics.channels["half-shaft.twist"];
                    for (cell, value) in cells.iter().zip([
                        twist.minimum,
                        twist.maximum,
                        twist.amplitude,
                        twist.mean,
                    ]) {
                        assert_shows(super::summary::value(cell), value, 5);
                    }
                }
            },
            Answer::Resonance(result) => {
                let (peak, scaling) = (&result.peaks[0], &result.scaling[0]);
                assert_shows(number_after(&told, "most at"), peak["frequency"], 5);
                assert_shows(number_after(&told, "swings by ±"), peak["rho"], 5);
                assert_shows(
                    number_after(&told, "have to be"),
                    scaling.fold_threshold_factor.unwrap(),
                    4,
                );
                for point in &result.verification {
                    let speed = format!("{:.4}", point.frequency);
                    let cells = row(&shown, "Closed form held", &speed);
                    assert_shows(value(cells[1]), point.predicted, 6);
                    assert_shows(value(cells[2]), point.integrated, 6);
                }
            }
            Answer::Folds(result) => {
                let cusp = &result.special_points[0];
                assert_shows(
                    number_after(&told, "folds appear above"),
                    cusp.value("mode.f").unwrap(),
                    7,
                );
                assert_shows(number_after(&told, "cusp at"), cusp.value("frequency").unwrap(), 5);
                assert_shows(
                    number_after(&told, "the model has"),
                    result.parameter_value.unwrap(),
                    5,
                );
            }
            Answer::Bifurcation(result) => {
                let swept = result.values.values("frequency");
                assert_shows(number_after(&told, "period 1 from"), swept[0], 6);
                let most = result.values.values("lyapunov_exponent").iter().copied();
                let most = most.fold(f64::NEG_INFINITY, f64::max);
                assert_shows(number_after(&told, "Largest Lyapunov exponent"), most, 4);
            }
            Answer::Basins(_) | Answer::Study(_) | Answer::Report(_) => {
                unreachable!("no such verb was asked")
            }
        }
    }
    assert_eq!(seen, 10, "every verb has its answer");
}

fn statics(result: &StaticResult, told: &str) {
    assert_shows(number_after(told, "The twist of the half-shaft is"), by_hand::twist(DEMAND), 5);
    assert_shows(number_after(told, "The law can carry"), by_hand::capacity(), 6);
    assert_shows(number_after(told, "N·m at most, at"), by_hand::limit_twist(), 5);
    let margin = by_hand::capacity() / DEMAND;
    assert_shows(number_after(from(told, "N·m at most"), "°): "), margin, 3);
    for gear in &result.gears {
        // 5.82 28247 7814.18 N·m – does not hold
        let row = &told[told.find("In every gear").unwrap()..];
        let asked = number_after(row, &format!(" {} ", gear.ratio));
        assert!((asked - gear.ratio * DEMAND).abs() <= 0.5, "{asked}");
    }
}

// Source: the limit that the program states, counted here in columns of a terminal.
#[test]
fn no_line_is_too_wide() {
    let long = "Antriebswelle".repeat(12);
    let names = [
        ("half-shaft", long.as_str()),
        ("vehicle", "車両の慣性モーメントと車輪"),
        (
            "engine torque",
            "a b c d e f g h i j k l m n o p q r s t u v w x y z 0 1 2 3 4 5 6 7 8 9",
        ),
    ];
    let mut all = answers(&line(embedded::example(), &[]));
    all.extend([EMBEDDED.clone(), OVERLOADED.clone(), HARDENING.clone(), SCALED.clone()]);
    let odd: Vec<Answer> = all.iter().map(|answer| renamed(answer, &names)).collect();
    assert_eq!(WIDTH, 100);
    for answer in all.iter().chain(&odd) {
        let shown = text(answer);
        for line in shown.lines() {
            assert!(columns(line) <= WIDTH, "{} columns: {line}", columns(line));
            assert_eq!(line.trim_end(), line, "blanks at the end");
        }
        assert!(shown.ends_with('\n') && !shown.ends_with("\n\n"));
        assert!(!shown.contains("\n\n\n"), "two empty lines");
    }
}

// Source: the report's sections: each that is missing is told with its reason.
#[test]
fn what_has_no_answer_is_told() {
    let report = the_report(&OVERLOADED);
    assert!(report.modes.is_none() && report.missing.len() >= 3);
    let told = flat(&text(&OVERLOADED));
    assert!(told.contains("Not answered: modes of vibration, shock and resonance."), "{told}");
    let reason = flat(&report.missing[0].reason.replace('-', "−"));
    assert!(told.to_lowercase().replace('-', "−").contains(&reason.to_lowercase()), "{told}");
}

// Source: the model: what it says of the line as a whole is said again, and of a line that says nothing of
// the kind nothing is.
#[test]
fn check_tells_what_holds_for_the_line_as_a_whole() {
    let checked = |lines: &str| {
        let disc = "format = 1\nname = \"disc\"\n[[inertia]]\nname = \"disc\"\ninertia = 2\n";
        let rod = "[[shaft]]\nname = \"rod\"\nfrom = \"disc\"\nto = \"ground\"\nstiffness = 50\n";
        flat(&text(
            &ask(&written(&format!("{disc}{rod}{lines}")), &Question::Check, &Silent).unwrap(),
        ))
    };
    let told = checked(
        "[line]\nmodal_damping = \"2 %\"\nloss_factor = 0.01\noperating = \"800 rpm..6000 rpm\"\n",
    );
    for part in ["modal damping of 2 %", "a loss factor of 0.01", "run from 800 to 6000 rpm"] {
        assert!(told.contains(part), "{part} in {told}");
    }
    assert!(!checked("").contains("The line as a whole"));
}
