//! Answers made by hand, for tests of what is told of them.

use halfshaft_results::{
    Branch, Column, FoldsResult, Header, ModelIdentity, ResonanceResult, SpecialPoint, Table,
    Termination,
};
use serde_json::{Value, json};

pub(crate) fn header(analysis: &str, settings: Value) -> Header {
    Header {
        analysis: analysis.to_owned(),
        model: ModelIdentity { name: "Made up".to_owned(), digest: "0123456789abcdef".to_owned() },
        settings,
        termination: Termination::completed(),
        version: "0.0.0".to_owned(),
        warnings: Vec::new(),
        assumptions: Vec::new(),
    }
}

/// Rows of a branch: speed, half of peak to peak, stable.
pub(crate) type Rows<'r> = &'r [(f64, f64, bool)];

/// A resonance by harmonic balance of such branches; the first harmonic is 0.9 of the swing.
pub(crate) fn resonance(branches: &[(Rows<'_>, Vec<SpecialPoint>)]) -> ResonanceResult {
    let branches = branches.iter().map(|(rows, points)| branch(rows, points.clone())).collect();
    ResonanceResult {
        header: header("resonance", json!({ "method": "harmonic-balance" })),
        branches,
        scaling: Vec::new(),
        peaks: Vec::new(),
        backbones: Vec::new(),
        jumps: Vec::new(),
        effort: None,
        verification: Vec::new(),
    }
}

fn branch(rows: Rows<'_>, points: Vec<SpecialPoint>) -> Branch {
    let column = |name: &str, unit: &str, of: fn(&(f64, f64, bool)) -> f64| {
        Column::new(name, unit, rows.iter().map(of).collect())
    };
    let columns = vec![
        column("frequency", "rad/s", |row| row.0),
        column("spring.twist.harmonic1", "rad", |row| 0.9 * row.1),
        column("spring.twist.amplitude", "rad", |row| row.1),
        column("spring.twist.mean", "rad", |_| 0.0),
        column("stable", "1", |row| f64::from(u8::from(row.2))),
    ];
    Branch::plain(columns, points)
}

/// A plane of `drive.amplitude` over 30 to 200 N·m with the model at `own`; curves as pairs of
/// speed and amplitude.
pub(crate) fn plane(
    curves: &[&[(f64, f64)]],
    special_points: Vec<SpecialPoint>,
    own: f64,
) -> FoldsResult {
    let table = |curve: &&[(f64, f64)]| {
        let (speeds, values) = curve.iter().copied().unzip();
        Table::new(vec![
            Column::new("frequency", "rad/s", speeds),
            Column::new("drive.amplitude", "N·m", values),
        ])
    };
    let parameter = json!({ "address": "drive.amplitude", "from": 30.0, "to": 200.0 });
    FoldsResult {
        header: header("folds", json!({ "frequency": [25.0, 60.0], "parameter": parameter })),
        curves: curves.iter().map(table).collect(),
        special_points,
        parameter: "drive.amplitude".to_owned(),
        parameter_unit: "N·m".to_owned(),
        parameter_value: Some(own),
        scaling: None,
        responses: None,
    }
}
