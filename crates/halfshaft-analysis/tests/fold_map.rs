//! `folds` by harmonic balance: the map of the number of responses.

mod common;
#[path = "common/lines.rs"]
mod lines;

use common::{line_of, some, try_ask};
use halfshaft_model::question::{QuestionText, Verb};
use halfshaft_results::Answer;

// Source: the number of responses changes at folds only, so that between two neighbours of the map
// with different numbers a curve of folds must pass.
#[test]
fn numbers_of_responses_change_at_folds_only() {
    let text = QuestionText {
        parameter: some("spring.cubic=-1..-0.1"),
        frequency: some("0.45..1.2"),
        ..QuestionText::default()
    };
    let Ok(Answer::Folds(result)) = try_ask(&line_of(&lines::d1(), &[]), Verb::Folds, &text) else {
        panic!("is answered");
    };
    let map = result.responses.expect("counted");
    let cell = |list: &[f64]| list[1] - list[0];
    let (wide, high) = (cell(&map.frequency), cell(&map.parameter));
    let mut points: Vec<(f64, f64)> = Vec::new();
    for curve in &result.curves {
        let column = |name: &str| &curve.column(name).expect("is there").values;
        let (f, p) = (column("frequency"), column("spring.cubic"));
        for k in 1..f.len() {
            let part = |m: u32| f64::from(m) / 60.0;
            points.extend((0..=60).map(|m| {
                (f[k - 1] + part(m) * (f[k] - f[k - 1]), p[k - 1] + part(m) * (p[k] - p[k - 1]))
            }));
        }
    }
    let passes = |f: f64, p: f64| {
        points.iter().any(|(x, y)| (x - f).abs() <= 1.5 * wide && (y - p).abs() <= 1.5 * high)
    };
    let mut changes = 0;
    for row in 1..map.parameter.len() {
        for column in 1..map.frequency.len() {
            let (f, p) = (map.frequency[column], map.parameter[row]);
            let here = map.count[row][column];
            for other in [map.count[row - 1][column], map.count[row][column - 1]] {
                if other != here {
                    changes += 1;
                    assert!(passes(f, p), "{other} beside {here} at {f}, {p}");
                }
            }
        }
    }
    assert!(changes > 50, "{changes}");
}
