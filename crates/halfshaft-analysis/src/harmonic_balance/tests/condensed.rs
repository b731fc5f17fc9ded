//! Condensed lines against the same lines with every group kept.

use std::rc::Rc;

use super::{Traced, lines, setting_of, traced_with};
use crate::harmonic_balance::channels::group_series;
use crate::harmonic_balance::line::{Line, nonlinear};
use crate::harmonic_balance::problem::{Axis, Problem};
use crate::harmonic_balance::skeleton::Skeleton;
use crate::harmonic_balance::system::{HarmonicSystem, Place};
use crate::harmonic_balance::tracer::length;

/// The same line with nothing taken out.
fn uncondensed(line: &Line) -> Line {
    let flags = nonlinear(&line.equations);
    let skeleton = Skeleton::keeping_all(&line.equations, &flags);
    assert_eq!(skeleton.kept.len(), line.equations.groups());
    assert!(skeleton.steps.is_empty());
    Line::with_skeleton(Rc::clone(&line.equations), Rc::new(skeleton))
}

/// Largest difference of the angles of all groups from those of the full system, at every
/// `every`-th sample, relative to all of them.
fn compare(found: &Traced, every: usize) -> f64 {
    let full = uncondensed(&found.setting.line);
    let mut worst = 0.0_f64;
    // Where branches part the Jacobian is singular.
    for branch in found.collected.branches.iter().filter(|branch| branch.periods == 1) {
        for sample in branch.samples.iter().step_by(every) {
            let place = Place { frequency: sample.p, drive: 1.0 };
            let new =
                |line: &Line| HarmonicSystem::new(line.clone(), sample.set.clone(), branch.base);
            let mut condensed = new(&found.setting.line);
            let series = group_series(&mut condensed, &sample.u, place);
            let mut problem = Problem::new(new(&full), Axis::Frequency, place);
            // Start away from the answer, so that it has to be found again.
            let mut u = shifted(&full, &found.setting.line, &series);
            let answer = u.clone();
            let size = length(&u);
            for (k, value) in u.iter_mut().enumerate() {
                *value += 1e-4 * size * (k as f64 * 2.3).sin() / (series.len() as f64).sqrt();
            }
            problem.at(&mut u, sample.p, size).expect("converges");
            // Newton's method has left an error of the square of its last step.
            problem.at(&mut u, sample.p, size).expect("converges");
            let away = u.iter().zip(&answer).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            worst = worst.max(away / size);
        }
    }
    worst
}

/// A free line's angle is pinned at different nodes: both at the same.
fn shifted(full: &Line, condensed: &Line, series: &[f64]) -> Vec<f64> {
    let mut series = series.to_vec();
    let Some(rigid) = &full.equations.rigid else { return series };
    assert!(condensed.free);
    let m = series.len() / full.nodes();
    let last = full.skeleton.kept[full.skeleton.pattern.last()];
    let by = series[last * m] / rigid.speeds[last];
    for (group, speed) in rigid.speeds.iter().enumerate() {
        series[group * m] -= by * speed;
    }
    series
}

fn traced(text: &str, range: (f64, f64)) -> Traced {
    traced_with(setting_of(text, range), 1e-8, None)
}

#[test]
fn a_row_of_fifty_is_the_full_row() {
    for held in [true, false] {
        let found = traced(&lines::long_row(50, 20, held), (3.4, 4.6));
        assert_eq!(found.setting.line.nodes(), 2);
        let worst = compare(&found, 4);
        assert!(worst < 1e-10, "{worst:e}, held: {held}");
    }
}

#[test]
fn other_lines_are_the_full_lines() {
    for (text, range) in [
        (lines::geared(), (2.0, 60.0)),
        (lines::mesh(), (2.0, 20.0)),
        (lines::full_mesh(), (2.0, 30.0)),
        (lines::free_damped(), (8.0, 35.0)),
        (lines::chain(6, |k| k == 3), (10.0, 70.0)),
        (lines::chain(5, |_| false), (10.0, 70.0)),
    ] {
        let worst = compare(&traced(&text, range), 5);
        assert!(worst < 1e-10, "{worst:e}\n{text}");
    }
}
