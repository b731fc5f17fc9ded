//! The paper as a study: harmonic balance beside averaging, against reference numbers from elsewhere.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use halfshaft::model::study::read_study;
use halfshaft::results::{ComparisonRow, StudyResult};
use halfshaft::{Silent, run_study};

fn paper() -> StudyResult {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples"));
    let study = read_study(&folder.join("two-mass-driveline/paper.toml")).expect("is sound");
    run_study(&study, &Silent)
}

fn difference(row: &ComparisonRow) -> f64 {
    row.printed_value.unwrap() / row.recomputed_value.unwrap() - 1.0
}

// Source: reference numbers of the driveline with coefficients before rounding, by a continuation
// program and two independent ones: folds at f = 15 to 1e-8, the cusp over f to 1e-7; thresholds of the
// full equations differ from those of averaging by less than a percent.
#[test]
fn harmonic_balance_meets_the_reference_beside_averaging() {
    let result = paper();
    assert!(result.header.termination.is_complete(), "{:?}", result.header);
    let unrounded: Vec<&ComparisonRow> = result
        .comparisons
        .iter()
        .filter(|row| row.remark.starts_with("source: ") && row.what.contains("harmonic balance"))
        .collect();
    assert_eq!(unrounded.len(), 5, "two folds with their swings, and the cusp");
    for row in unrounded {
        let bound = if row.what.contains("threshold") { 1e-7 } else { 1e-8 };
        assert!(difference(row).abs() < bound, "{row:?}");
    }
    let thresholds: Vec<&ComparisonRow> =
        result.comparisons.iter().filter(|row| row.what.ends_with(", harmonic balance")).collect();
    assert!(thresholds.len() > 8, "{thresholds:?}");
    for row in thresholds.iter().filter(|row| row.what.starts_with("threshold")) {
        assert!(difference(row).abs() < 0.01, "{row:?}");
    }
    // As many folds as averaging has.
    for row in thresholds.iter().filter(|row| row.what.starts_with("folds at")) {
        assert_eq!(row.printed_value, row.recomputed_value, "{row:?}");
    }
}
