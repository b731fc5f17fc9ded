//! What is told and drawn of periodic responses with everything that can happen on them.

use halfshaft::Answer;
use halfshaft::present::figure::{Curve, Direction, Figure, Item, Line, Region};
use halfshaft::present::figures;
use halfshaft::present::summary::text;
use halfshaft::results::{Branch, FoldsResult, ResonanceResult, SpecialKind};

use super::common::{assert_shows, flat, number_after};
use super::figures::{figure, points};
use super::made::{self, HARMONICS, TRUNCATION};

const RPM: f64 = 30.0 / std::f64::consts::PI;

fn told(answer: ResonanceResult) -> (ResonanceResult, String) {
    let text = flat(&text(&Answer::Resonance(answer.clone())));
    (answer, text)
}

fn branch_of(result: &ResonanceResult, wanted: impl Fn(&Branch) -> bool) -> &Branch {
    result.branches.iter().find(|branch| wanted(branch)).expect("is there")
}

fn range(values: &[f64]) -> (f64, f64) {
    let fold = |from: f64, pick: fn(f64, f64) -> f64| values.iter().copied().fold(from, pick);
    (fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max))
}

// Source: the one-harmonic equation of made.rs: at its peak both of its speeds meet.
#[test]
fn the_peak_is_that_of_the_response_which_sweeps_show() {
    let (_, told) = told(made::resonance());
    let (speed, a) = made::peak();
    // Its neighbours among the samples are as close as this.
    assert!((number_after(&told, "most at") / speed - 1.0).abs() < 1e-3, "{told}");
    assert_shows(number_after(&told, "swings by ±"), 1.01 * a, 5);
    assert_shows(number_after(&told, "its torque by ±"), 103.0 * a, 5);
    assert!(!told.contains("That response is not stable"), "{told}");
}

// Source: the made-up answer itself.
#[test]
fn jumps_are_told_with_speed_and_amplitudes() {
    let (_, told) = told(made::resonance());
    let [(up, before), (down, below)] = made::folds();
    let sweep = &told[told.find("Sweeping up").unwrap()..];
    assert_shows(number_after(sweep, "jumps at"), up * RPM, 5);
    assert_shows(number_after(sweep, "rpm ("), up, 6);
    assert_shows(number_after(sweep, "from ±"), before, 4);
    assert_shows(number_after(sweep, "to ±"), 0.14, 4);
    let sweep = &told[told.find("Sweeping down").unwrap()..];
    // Half of peak to peak is 1.01 of the first harmonic there.
    assert_shows(number_after(sweep, "leaves ±"), 1.01 * below, 4);
    assert_shows(number_after(sweep, "peak) at"), down * RPM, 5);
    assert!(sweep.contains("no other periodic response is there"), "{sweep}");
}

// Source: the made-up answer itself: where each of its branches lies, by hand.
#[test]
fn what_no_sweep_shows_is_called_out() {
    let (result, told) = told(made::resonance());
    let detached = branch_of(&result, |branch| branch.closed);
    let (from, to) = range(detached.values("frequency"));
    let (least, most) = range(detached.values("spring.twist.amplitude"));
    let sentence = &told[told.find("A detached response exists").expect("is told")..];
    assert_shows(number_after(sentence, "between"), from * RPM, 5);
    assert_shows(number_after(sentence, "and"), to * RPM, 5);
    assert_shows(number_after(sentence, "±"), least, 4);
    assert_shows(number_after(sentence, "to ±"), most, 4);
    assert!(sentence.contains("stable in part), which a slow sweep never shows"), "{sentence}");
    let sentence = &told[told.find("there is a response of twice the period").unwrap()..];
    assert!(sentence.contains("from the period doubling at 0.96 rad/s"), "{sentence}");
    assert!(sentence.contains("stable throughout"), "{sentence}");
    // Between 1 and 1.02 rad/s the main response beats, and there is no other.
    let gap = &told[told.find("No stable periodic response was found").unwrap()..];
    assert_shows(number_after(gap, "between"), 1.0 * RPM, 5);
    assert_shows(number_after(gap, "and"), 1.02 * RPM, 5);
    assert_eq!(told.matches("No stable periodic response").count(), 1);
    // Two folds of the main response and two of the detached one: five lie over each other.
    assert!(told.contains("Up to five responses exist side by side"), "{told}");
}

// Source: the contract's kinds of special points, and the made-up answer itself.
#[test]
fn every_special_point_has_its_row() {
    let (result, _) = told(made::resonance());
    let shown = text(&Answer::Resonance(result.clone()));
    let table = &shown[shown.find("Special points").unwrap()..];
    let table = &table[..table.find("\n\n").unwrap()];
    let all = result.branches.iter().flat_map(|branch| &branch.special_points);
    let all: Vec<_> = all.filter(|point| point.kind != SpecialKind::End).collect();
    assert_eq!(all.len(), 8);
    for point in all {
        let word = match point.kind {
            SpecialKind::Fold => "fold",
            SpecialKind::PeriodDoubling => "period doubling",
            SpecialKind::NeimarkSacker => "Neimark-Sacker",
            other => panic!("{other:?}"),
        };
        let speed = format!("{:.8}", point.value("frequency").unwrap());
        let row = table.lines().find(|line| line.contains(&speed));
        let row = row.unwrap_or_else(|| panic!("no {speed} in\n{table}"));
        assert!(row.trim_start().starts_with(word), "{row}");
        let a = format!("{:.7}", point.value("spring.twist.harmonic1").unwrap());
        assert!(row.contains(&a), "{row}");
    }
    // 0.560218 rad in degrees.
    assert_eq!(table.matches("32.098").count(), 2, "{table}");
    for explained in ["repeats only every second period", "begins to beat", "a slow sweep jumps"] {
        assert!(flat(&shown).contains(explained), "no {explained}");
    }
}

// Source: the made-up answer itself.
#[test]
fn accuracy_and_effort_are_told() {
    let (result, told) = told(made::resonance());
    assert_shows(number_after(&told, "Harmonic balance kept"), HARMONICS, 3);
    assert_shows(number_after(&told, "left out are at most"), TRUNCATION, 2);
    let effort = result.effort.unwrap();
    assert!(told.contains(&format!("{} samples in three responses", effort.samples)), "{told}");
    assert!(told.contains(&format!("from {} starting points", effort.seeds)), "{told}");
    assert!(told.contains("harmonic balance differs by 2×10⁻⁷ %"), "{told}");
    assert!(told.contains("the largest multipliers to 3×10⁻⁸"), "{told}");
    assert!(told.contains("Harmonic balance held against integration"), "{told}");
    let sentence = &told[told.find("At the largest stable response").unwrap()..];
    assert_shows(number_after(sentence, "multiplier is"), 0.88, 4);
}

// Source: the made-up answer itself: nothing of speeds where a parameter was gone through.
#[test]
fn over_a_parameter_everything_is_told_by_its_value() {
    let (result, told) = told(made::over_a_parameter());
    assert!(told.starts_with("Resonance: Made up"), "{told}");
    assert_shows(number_after(&told, "At an excitation speed of"), 1.06, 5);
    let address = "excitation.amplitude";
    let (_, most) = range(result.branches[0].values(address));
    assert_shows(number_after(&told, "where the excitation amplitude is"), most, 6);
    assert!(told.contains("Up to three responses exist side by side, between"), "{told}");
    let table = &told[told.find("Special points").unwrap()..];
    for fold in &result.branches[0].special_points {
        let value = format!("{:.9}", fold.value(address).unwrap());
        assert!(table.contains(&value), "no {value} in {table}");
    }
    let drawing = figure(&Answer::Resonance(result), "response");
    assert_eq!(drawing.panels[0].x.label, "Excitation amplitude");
    assert!(drawing.panels[0].x.secondary.is_none());
}

fn curves<'f>(figure: &'f Figure, panel: usize, name: &str) -> Vec<&'f Curve> {
    let of = |item: &'f Item| match item {
        Item::Curve(curve) if curve.name == name => Some(curve),
        _ => None,
    };
    figure.panels[panel].items.iter().filter_map(of).collect()
}

// Source: the answer's own columns: every piece between two samples is drawn, solid where both are
// stable, and a closed branch is closed.
#[test]
fn every_branch_is_drawn_in_its_own_look() {
    let result = made::resonance();
    let drawing = figure(&Answer::Resonance(result.clone()), "response");
    for (name, branch) in [
        ("response", branch_of(&result, |branch| !branch.closed && branch.periods == 1)),
        ("detached response", branch_of(&result, |branch| branch.closed)),
        ("of twice the period of the excitation", branch_of(&result, |b| b.periods == 2)),
    ] {
        let drawn = curves(&drawing, 0, name);
        let (x, y) = (branch.values("frequency"), branch.values("spring.twist.harmonic1"));
        let stable = branch.values("stable");
        for row in 0..x.len() {
            let there = |curve: &&&Curve| {
                curve.x.iter().zip(&curve.y).any(|place| place == (&x[row], &y[row]))
            };
            let solid = drawn.iter().filter(there).any(|curve| curve.line == Line::Solid);
            // Beside a sample that is not stable a stable one begins a dashed line.
            let near = [row.saturating_sub(1), row, (row + 1).min(x.len() - 1)];
            let calm = near.iter().all(|row| stable[*row] == 1.0);
            assert!(drawn.iter().any(|curve| there(&curve)), "{name} at {}", x[row]);
            assert!(solid || !calm, "{name} at {}", x[row]);
            assert!(!solid || stable[row] == 1.0, "{name} at {}", x[row]);
        }
        assert!(drawn.iter().any(|curve| curve.in_legend), "{name}");
    }
    let colours = ["response", "detached response", "of twice the period of the excitation"]
        .map(|name| curves(&drawing, 0, name)[0].colour);
    assert!(colours[0] != colours[1] && colours[1] != colours[2] && colours[0] != colours[2]);
    assert_eq!(curves(&drawing, 0, "backbone").len(), 1);
}

// Source: the special points of the answer.
#[test]
fn every_kind_of_point_has_its_marker() {
    let result = made::resonance();
    let drawing = figure(&Answer::Resonance(result.clone()), "response");
    let all: Vec<_> = result.branches.iter().flat_map(|branch| &branch.special_points).collect();
    let mut markers = Vec::new();
    for (kind, name) in [
        (SpecialKind::Fold, "fold"),
        (SpecialKind::PeriodDoubling, "period doubling"),
        (SpecialKind::NeimarkSacker, "Neimark-Sacker (torus)"),
    ] {
        let of_kind = all.iter().filter(|point| point.kind == kind);
        let speeds: Vec<f64> = of_kind.map(|point| point.value("frequency").unwrap()).collect();
        let drawn = points(&drawing, name).expect("is drawn");
        assert_eq!(drawn.x, speeds, "{name}");
        markers.push(drawn.marker);
    }
    assert!(markers[0] != markers[1] && markers[1] != markers[2] && markers[0] != markers[2]);
    assert_eq!(points(&drawing, "integrated").unwrap().x.len(), 2);
    assert_eq!(points(&drawing, "integrated, not stable").unwrap().x.len(), 1);
}

// Source: the answer's multipliers: stability is lost at 1, inside and outside of the unit circle.
#[test]
fn multipliers_are_drawn_against_one() {
    let result = made::resonance();
    let answer = Answer::Resonance(result.clone());
    let drawing = figure(&answer, "response");
    let limit = drawing.panels[1].items.iter().find_map(|item| match item {
        Item::Reference(line) if line.axis == Direction::Horizontal => Some(line.value),
        _ => None,
    });
    assert_eq!(limit, Some(1.0));
    let plane = figure(&answer, "multipliers");
    let all = result.branches.iter().flat_map(|branch| &branch.multipliers).flatten();
    let outside: Vec<_> = all.filter(|one| one[0].hypot(one[1]) > 1.0).collect();
    let drawn = points(&plane, "outside: not stable").expect("some are");
    // A pair each, but of those that would run into each other one: none is farther from a dot than
    // the diagonal of a cell, of which 45 lie along half of the plane, here 1.32 wide.
    assert!(drawn.x.len() <= 2 * outside.len());
    for (one, sign) in outside.iter().flat_map(|one| [(one, 1.0), (one, -1.0)]) {
        let mut dots = drawn.x.iter().zip(&drawn.y);
        assert!(dots.any(|(x, y)| (x - one[0]).hypot(y - sign * one[1]) <= 1.42 * 1.32 / 45.0));
    }
    assert!(drawn.x.iter().zip(&drawn.y).all(|(x, y)| x.hypot(*y) > 1.0));
    // Where none leaves the circle there is nothing to see.
    let mut calm = result;
    for branch in &mut calm.branches {
        branch.multipliers.iter_mut().for_each(|row| *row = vec![[0.5, 0.0]]);
    }
    assert!(figures::of(&Answer::Resonance(calm)).iter().all(|figure| figure.id != "multipliers"));
}

fn holds(region: &Region, x: f64, y: f64) -> bool {
    let places: Vec<(f64, f64)> = region.x.iter().copied().zip(region.y.iter().copied()).collect();
    let mut inside = false;
    for area in places.split(|place| !place.0.is_finite()) {
        for (index, (x1, y1)) in area.iter().enumerate() {
            let (x2, y2) = area[(index + 1) % area.len()];
            if (*y1 > y) != (y2 > y) && x < x1 + (x2 - x1) * (y - y1) / (y2 - y1) {
                inside = !inside;
            }
        }
    }
    inside
}

fn folds_figure(result: FoldsResult) -> Figure {
    figure(&Answer::Folds(result), "folds-excitation.amplitude")
}

// Source: the number of responses by the formula that the count was made from; a place on an edge
// belongs to neither side.
#[test]
fn tints_tell_how_many_responses_there_are() {
    let drawing = folds_figure(made::folds_plane());
    let regions: Vec<&Region> = drawing.panels[0]
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Region(region) => Some(region),
            _ => None,
        })
        .collect();
    let names: Vec<&str> = regions.iter().map(|region| region.name.as_str()).collect();
    assert_eq!(names, ["one response: no jump", "three responses", "five responses"]);
    let mut wrong = 0;
    for across in 0..40 {
        for up in 0..40 {
            let (w, p) = (
                1.0 + 0.2 * (f64::from(across) + 0.37) / 40.0,
                0.0051 + 0.0248 * (f64::from(up) + 0.41) / 40.0,
            );
            let found: Vec<&str> =
                regions.iter().filter(|region| holds(region, w, p)).map(|r| &*r.name).collect();
            let wanted = names[(made::count(w, p) as usize - 1) / 2];
            assert!(found.len() <= 1, "{w} {p}: {found:?}");
            wrong += usize::from(found != [wanted]);
        }
    }
    // Half a row of the grid at the tip of the wedge and at those of the lens.
    assert!(wrong <= 8, "{wrong} of 1600");
    let labels: Vec<&str> = drawing.panels[0]
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Label(label) => Some(label.text.as_str()),
            _ => None,
        })
        .collect();
    assert_eq!(labels, ["1", "3", "5"]);
}

// Source: the special points of the plane.
#[test]
fn births_and_mergers_are_marked_and_told() {
    let result = made::folds_plane();
    let drawing = folds_figure(result.clone());
    let mut looks = Vec::new();
    for (kind, name) in [
        (SpecialKind::Cusp, "cusp"),
        (SpecialKind::IsolaBirth, "birth of a detached response"),
        (SpecialKind::IsolaMerger, "merger of a detached response"),
    ] {
        let point = result.special_points.iter().find(|point| point.kind == kind).unwrap();
        let drawn = points(&drawing, name).expect("is drawn");
        assert_eq!(
            (drawn.x[0], drawn.y[0]),
            (point.value("frequency").unwrap(), point.value("excitation.amplitude").unwrap(),)
        );
        looks.push(drawn.marker);
    }
    assert!(looks[0] != looks[1] && looks[1] != looks[2] && looks[0] != looks[2]);
    let told = flat(&text(&Answer::Folds(result)));
    let born = &told[told.find("A detached response is born").unwrap()..];
    assert_shows(number_after(born, "amplitude is"), 0.018, 7);
    assert_shows(number_after(born, "N·m, at"), 1.12, 5);
    let joined = &told[told.find("joins another one").unwrap()..];
    assert_shows(number_after(joined, "amplitude is"), 0.026, 7);
    assert!(told.contains("Up to five responses exist side by side in this plane"), "{told}");
}
