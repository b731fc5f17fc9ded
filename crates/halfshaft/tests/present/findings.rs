//! What a report finds: what holds, what does not, by how much.

use halfshaft::model::embedded;
use halfshaft::present::summary;

use super::common::by_hand::{self, DEMAND, K1, K3};
use super::common::{
    EMBEDDED, OVERLOADED, SCALED, assert_shows, flat, line, number_after, static_report,
};

/// The summary of a report in one line, from its findings on.
fn told(answer: &halfshaft::Answer) -> String {
    let text = flat(&summary::text(answer));
    text[text.find("- [").expect("findings")..].to_owned()
}

/// The findings of the embedded example with settings, from its statics only.
fn in_gear(ratio: &str) -> String {
    let set = format!("gearbox.ratio={ratio}");
    told(&static_report(&line(embedded::example(), &[&set])))
}

// Source: the law by hand: the half-shaft carries at most 2/3 k1 √(k1/(3|k3|)) = 7814.175 N·m,
// direct gear asks 850 · 5.71 N·m. So ratio 1.61 asks 7814.135 N·m and just holds, 1.6101 does not;
// the margin is 1.25 at ratio 1.28802.
#[test]
fn the_margin_decides_between_safe_watch_and_unsafe() {
    let edge = by_hand::capacity() / DEMAND;
    assert!(1.61 < edge && edge < 1.6101);
    assert!(1.2880 < edge / 1.25 && edge / 1.25 < 1.2881);
    for (ratio, word) in [
        ("1", "safe"),
        ("1.2880", "safe"),
        ("1.2881", "watch"),
        ("1.61", "watch"),
        ("1.6101", "not safe"),
    ] {
        let text = in_gear(ratio);
        assert!(text.contains(&format!("[{word}] Steady running:")), "{ratio}: {text}");
    }
    // In reverse the torque is as large and so is the law.
    assert!(in_gear("-1.2880").contains("[safe] Steady running:"));
    assert!(in_gear("-1.6101").contains("[not safe] Steady running:"));
}

// Source: the same by hand.
#[test]
fn the_load_is_told_with_capacity_demand_and_ratio() {
    let text = told(&EMBEDDED);
    let steady = &text[text.find("Steady running").unwrap()..];
    assert_shows(number_after(steady, "can carry"), by_hand::capacity(), 4);
    assert_shows(number_after(steady, "asks"), DEMAND, 4);
    assert_shows(number_after(steady, "N·m: "), by_hand::capacity() / DEMAND, 3);

    let text = told(&OVERLOADED);
    assert!(text.starts_with("- [not safe] Steady running: There is no stable state"), "{text}");
    assert_shows(number_after(&text, "have to carry"), 1.79 * DEMAND, 4);
    assert_shows(number_after(&text, "can carry"), by_hand::capacity(), 4);
    assert_shows(
        number_after(&text, "7814 N·m,"),
        100.0 * by_hand::capacity() / (1.79 * DEMAND),
        3,
    );
}

// Source: the same by hand, gear by gear of the file's list.
#[test]
fn gears_that_do_not_hold_are_told_with_what_they_ask() {
    let text = told(&EMBEDDED);
    let fail = &text[text.find("[not safe] Gears").unwrap()..text.find("[safe] Steady").unwrap()];
    for ratio in [5.82, 3.23, 1.79] {
        assert_shows(number_after(fail, &format!("{ratio} asks")), ratio * DEMAND, 4);
    }
    let hold = &text[text.find("[safe] Gears").unwrap()..];
    assert!(hold.starts_with("[safe] Gears 1 and 0.64: The tightest is 1:"), "{hold}");
    assert_shows(number_after(hold, "it asks"), DEMAND, 4);
}

// Source: a gearbox whose only other gear asks for a margin between 1 and 1.25.
#[test]
fn the_tightest_gear_gives_the_standing() {
    let text = embedded::example().text.replace("[5.82, 3.23, 1.79, 1, 0.64]", "[1.5, 1]");
    let text = told(&static_report(&super::common::written(&text)));
    assert!(
        text.contains("[watch] Gears 1.5 and 1: The tightest is 1.5: it asks 7280 N·m"),
        "{text}"
    );
}

// Source: the theory by hand: twist at rest by Viète, tangent stiffness k1 + 3 k3 x², effective
// cubic coefficient α = (k3 − 10 (3 k3 x)²/(9 k))/m, fold threshold of section 5.
#[test]
fn jumps_are_told_with_their_distance() {
    let text = told(&EMBEDDED);
    let (mass, rest) = (by_hand::inertia(), by_hand::twist(DEMAND));
    let tangent = K1 + 3.0 * K3 * rest * rest;
    let omega = (tangent / mass).sqrt();
    let alpha = (K3 - 10.0 * (3.0 * K3 * rest).powi(2) / (9.0 * tangent)) / mass;
    // 40 N·m through the final drive, over the engine's inertia seen from the half-shaft.
    let f = 40.0 / (0.328 * 5.71);
    let factor = by_hand::fold_threshold(omega, alpha, 90.0 / mass) / f;
    let jumps = &text[text.find("[safe] Jumps").unwrap()..];
    assert_shows(number_after(jumps, "have to be"), factor, 4);
    // The threshold grows with damping to the power 3/2.
    assert_shows(number_after(jumps, "from 90 to"), 90.0 * factor.powf(-2.0 / 3.0), 4);

    // The scaled oscillator is driven beyond its threshold.
    let text = told(&SCALED);
    let share = by_hand::fold_threshold(26.06, -0.679, 0.0951) / 10.0;
    assert!(share < 1.0 && text.starts_with("- [not safe] Jumps: The response jumps."), "{text}");
    assert_shows(number_after(&text, "an excitation below"), 100.0 * share, 4);
    assert_shows(number_after(&text, "or with"), share.powf(-2.0 / 3.0), 4);
}

// Source: the theory by hand: the peak of the averaged response, and the room from rest to the
// limit of the law.
#[test]
fn vibration_is_held_against_the_room_that_is_left() {
    let text = told(&EMBEDDED);
    let resonance = &text[text.find("[safe] Resonance").unwrap()..];
    let (mass, rest) = (by_hand::inertia(), by_hand::twist(DEMAND));
    let room = by_hand::limit_twist() - rest;
    let omega = ((K1 + 3.0 * K3 * rest * rest) / mass).sqrt();
    // At its peak the response is that of damping alone: f/(β ω).
    let swing = 40.0 / (0.328 * 5.71) / (90.0 / mass * omega);
    assert_shows(number_after(resonance, "swings by ±"), swing, 4);
    assert_shows(number_after(resonance, "% of the"), room, 4);
    let swings = &resonance[resonance.find("swings by").unwrap()..];
    assert_shows(number_after(swings, " rad ("), 100.0 * swing / room, 3);
}
