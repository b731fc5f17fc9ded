//! A report in which every method has an answer: the best one speaks, and all stand side by side.

use std::sync::LazyLock;

use halfshaft::Answer;
use halfshaft::present::figure::Item;
use halfshaft::present::summary::text;
use halfshaft::results::{MissingSection, ReportResult};

use super::common::{EVERY_METHOD_SCALED, SCALED, by_hand, flat, the_report};
use super::figures::{figure, points};
use super::html::Page;
use super::made;

static MADE: LazyLock<Answer> =
    LazyLock::new(|| Answer::Report(Box::new(made::with_every_method(the_report(&SCALED)))));

fn told(report: &ReportResult) -> String {
    flat(&text(&Answer::Report(Box::new(report.clone()))))
}

// Source: the issue: closed form, first harmonic, harmonic balance and integration in one figure.
#[test]
fn all_methods_stand_in_one_figure() {
    let drawing = figure(&MADE, "levels");
    for (name, result) in [
        ("closed form", &the_report(&MADE).closed_form),
        ("first harmonic", &the_report(&MADE).first_harmonic),
        ("harmonic balance", &the_report(&MADE).resonance),
    ] {
        let of_name = |item: &&Item| matches!(item, Item::Curve(curve) if curve.name == name);
        let drawn: Vec<f64> = drawing.panels[0]
            .items
            .iter()
            .filter(of_name)
            .flat_map(|item| match item {
                Item::Curve(curve) => curve.y.clone(),
                _ => Vec::new(),
            })
            .collect();
        let branches = &result.as_ref().unwrap().branches;
        for branch in branches {
            let swings = branch.values("spring.twist.harmonic1");
            assert!(
                !swings.is_empty() && swings.iter().all(|swing| drawn.contains(swing)),
                "{name}"
            );
        }
    }
    let integrated = points(&drawing, "integrated").expect("is drawn");
    let wanted = &the_report(&MADE).resonance.as_ref().unwrap().verification;
    assert!(integrated.y.iter().all(|y| wanted.iter().any(|point| point.integrated == *y)));
}

// Source: the theory by hand for the closed form: its folds (σ = −0.162719 and −0.120221 about
// 26.06 rad/s at ρ = 3.986246 and 2.283639) and the averaged equation; x'' + 26.06² x − 0.679 x³ +
// 0.0951 x' = 10 cos Ωt with one harmonic put in; for harmonic balance integration of the full
// equations, an independent method.
#[test]
fn real_methods_stand_side_by_side() {
    let report = the_report(&EVERY_METHOD_SCALED);
    let row = |what: &str| report.levels.iter().find(|row| row.what == what).expect("is there");
    for (fold, sigma, rho) in [(1, -0.162719, 3.986246), (2, -0.120221, 2.283639)] {
        let speed = row(&format!("fold {fold}: speed")).closed_form.unwrap();
        assert!((speed - 26.06 - sigma).abs() < 1e-6, "{speed}");
        let twist = row(&format!("fold {fold}: twist")).closed_form.unwrap();
        assert!((twist / rho - 1.0).abs() < 1e-6, "{twist}");
    }
    let checked: Vec<_> = report.levels.iter().filter(|row| row.integration.is_some()).collect();
    assert!(checked.len() > 4, "{checked:?}");
    for row in checked {
        let (balance, integration) = (row.harmonic_balance.unwrap(), row.integration.unwrap());
        assert!((balance / integration - 1.0).abs() < 1e-7, "{row:?}");
        let (speed, closed, first) =
            (row.at.unwrap(), row.closed_form.unwrap(), row.first_harmonic.unwrap());
        let (omega, alpha, beta, f) = (26.06, -0.679, 0.0951_f64, 10.0);
        let bent = speed - omega - 3.0 * alpha / (8.0 * omega) * closed * closed;
        let drive = 2.0 * omega * closed * (0.5 * beta).hypot(bent);
        assert!((drive / f - 1.0).abs() < 1e-5, "{row:?}: {drive}");
        let stiff = omega * omega - speed * speed + 0.75 * alpha * first * first;
        let drive = first * stiff.hypot(beta * speed);
        assert!((drive / f - 1.0).abs() < 1e-5, "{row:?}: {drive}");
    }
    let cusp = row("cusp: excitation amplitude");
    let threshold = by_hand::fold_threshold(26.06, -0.679, 0.0951);
    assert!((cusp.closed_form.unwrap() / threshold - 1.0).abs() < 1e-6, "{cusp:?}");
    // Averaging is half a percent high.
    let high = threshold / cusp.harmonic_balance.unwrap() - 1.0;
    assert!((high - 0.0046).abs() < 2e-4, "{high}");
}

// Source: the rows of the made-up report, by hand: the closed form against integration.
#[test]
fn differences_are_told_in_numbers() {
    let report = the_report(&MADE);
    let told = told(report);
    let worst = report
        .levels
        .iter()
        .filter_map(|row| Some((row.closed_form? / row.integration? - 1.0).abs()))
        .fold(0.0, f64::max);
    let shown = super::common::number_after(&told, "the closed form by at most");
    super::common::assert_shows(shown, 100.0 * worst, 2);
    assert!(told.contains("Values by every method, and differences"), "{told}");
    // Folds: harmonic balance is what the others are held against: 1/(1 + 2e-4) − 1.
    let folds = &told[told.find("The speeds of the folds").unwrap()..];
    let off = 100.0 * (1.0 - 1.0 / (1.0 + 2e-4));
    super::common::assert_shows(
        super::common::number_after(folds, "closed form by at most"),
        off,
        2,
    );
}

// Source: the issue: findings are built from harmonic balance where it has an answer.
#[test]
fn harmonic_balance_speaks_where_it_has_an_answer() {
    let report = the_report(&MADE);
    let told = told(report);
    let jump = &report.resonance.as_ref().unwrap().jumps[0];
    let jumps = &told[told.find("Jumps: The response jumps").unwrap()..];
    let speed = super::common::number_after(jumps, "rpm (");
    super::common::assert_shows(speed, jump.frequency, 6);
    assert!(told.contains("Harmonic balance agrees with integration"), "{told}");
    assert!(told.contains("Closed form: At its largest response the closed form agrees"), "{told}");
    // Its own cusps tell what would end the jumps: a threshold half a percent below the closed form.
    let plane = report.folds.iter().find(|p| p.parameter == "excitation.amplitude").unwrap();
    let cusp = plane.special_points[0].value("excitation.amplitude").unwrap();
    let share = super::common::number_after(jumps, "an excitation below");
    super::common::assert_shows(share, 100.0 * cusp / plane.parameter_value.unwrap(), 4);
}

// Source: the contract of the findings: a method that refuses the line is told by name.
#[test]
fn a_method_that_refuses_the_line_is_named() {
    let missing = |section: &str| MissingSection {
        section: section.to_owned(),
        reason: "two shafts are nonlinear".to_owned(),
        advice: None,
    };
    let mut report = the_report(&MADE).clone();
    report.first_harmonic = None;
    report.missing.push(missing("first-harmonic"));
    let text = told(&report);
    assert!(
        text.contains(
            "[note] Methods: The first harmonic gives no answer: two shafts are nonlinear."
        ),
        "{text}"
    );
    assert!(text.contains("Not answered: shock."), "{text}");
    report.resonance = None;
    report.folds.clear();
    report.missing.push(missing("resonance"));
    let text = told(&report);
    assert!(text.contains("[watch] Methods:"), "{text}");
    assert!(text.contains("What is said of resonance and jumps is by the closed form."), "{text}");
}

// Source: an XML parser and the sections of the page.
#[test]
fn the_page_has_a_section_for_each_method() {
    let page = Page::of(&MADE);
    let document = page.document();
    let ids: Vec<&str> = document
        .descendants()
        .filter(|node| node.tag_name().name() == "section")
        .filter_map(|node| node.attribute("id"))
        .collect();
    for wanted in ["resonance", "levels", "closed-form", "folds"] {
        assert!(ids.contains(&wanted), "{ids:?}");
    }
    let figures: Vec<&str> = document
        .descendants()
        .filter(|node| node.tag_name().name() == "figure")
        .filter_map(|node| node.attribute("id"))
        .collect();
    for wanted in ["fig-response", "fig-levels", "fig-response-2"] {
        assert_eq!(figures.iter().filter(|id| **id == wanted).count(), 1, "{figures:?}");
    }
    super::html::assert_sound(&page);
}
