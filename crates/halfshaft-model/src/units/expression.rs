//! Unit expressions: products, quotients and powers of unit names.
//!
//! Grammar (left to right, so `N·m/rad·s` is (N·m/rad)·s):
//!
//! ```text
//! expression := factor (operator? factor)*       operator := · ⋅ * × / or white space
//! factor     := "(" expression ")" power? | word power? | "1"
//! power      := "^" integer | "**" integer | digits | superscript digits
//! ```
//!
//! A word that is no unit by itself is split into units that follow each other ("Nm",
//! "kgm2", "kNm"). Such a word can have several readings ("Nms" is N·m·s or N·ms); all are
//! kept, and the one whose dimension fits the place is taken.

use super::catalog;
use super::dimension::Dimension;

/// One reading of a unit text: SI value and dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    pub(super) factor: f64,
    pub(super) dimension: Dimension,
}

const ONE: Reading = Reading { factor: 1.0, dimension: Dimension::NONE };

impl Reading {
    fn times(self, other: Self, sign: i8) -> Self {
        Self {
            factor: self.factor * other.factor.powi(i32::from(sign)),
            dimension: self.dimension + other.dimension * sign,
        }
    }

    fn power(self, power: i8) -> Self {
        Self { factor: self.factor.powi(i32::from(power)), dimension: self.dimension * power }
    }
}

/// Why a unit text cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnitError {
    /// A word that is no unit.
    #[error("unknown unit \"{word}\"")]
    Unknown {
        /// The word as written.
        word: String,
        /// A known unit of similar name.
        nearest: Option<String>,
    },
    /// A parenthesis without its partner, an operator without an operand, and the like.
    #[error("cannot read the unit \"{text}\"")]
    Syntax {
        /// The unit text as written.
        text: String,
    },
}

/// Longest unit text that is looked at; anything longer is a mistake.
const LONGEST: usize = 64;
/// Longest word, in bytes, that is split into units: splitting costs twice as much per letter.
const LONGEST_COMPOUND: usize = 12;
/// Deepest nesting of parentheses.
const DEEPEST: usize = 8;
/// More readings than this are never needed to tell units apart.
const MOST_READINGS: usize = 64;

/// All readings of a unit text, the plainest first.
pub(super) fn read(text: &str) -> Result<Vec<Reading>, UnitError> {
    let syntax = || UnitError::Syntax { text: text.to_owned() };
    if text.chars().count() > LONGEST {
        return Err(syntax());
    }
    let mut parser = Parser { rest: text, whole: text, depth: 0 };
    let readings = parser.expression()?;
    parser.skip_space();
    if parser.rest.is_empty() { Ok(readings) } else { Err(syntax()) }
}

struct Parser<'t> {
    rest: &'t str,
    whole: &'t str,
    depth: usize,
}

impl Parser<'_> {
    fn syntax(&self) -> UnitError {
        UnitError::Syntax { text: self.whole.to_owned() }
    }

    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn take(&mut self, symbols: &[&str]) -> bool {
        for symbol in symbols {
            if let Some(rest) = self.rest.strip_prefix(symbol) {
                self.rest = rest;
                return true;
            }
        }
        false
    }

    fn expression(&mut self) -> Result<Vec<Reading>, UnitError> {
        let mut product = self.factor()?;
        loop {
            self.skip_space();
            if self.rest.is_empty() || self.rest.starts_with(')') {
                return Ok(product);
            }
            let sign = if self.take(&["/"]) {
                -1
            } else {
                self.take(&["·", "⋅", "×", "*", "-", "."]);
                1
            };
            let factor = self.factor()?;
            product = combine(&product, &factor, sign);
        }
    }

    fn factor(&mut self) -> Result<Vec<Reading>, UnitError> {
        self.skip_space();
        if self.take(&["("]) {
            self.depth += 1;
            if self.depth > DEEPEST {
                return Err(self.syntax());
            }
            let inner = self.expression()?;
            self.depth -= 1;
            if !self.take(&[")"]) {
                return Err(self.syntax());
            }
            let power = self.power()?.unwrap_or(1);
            return Ok(inner.into_iter().map(|reading| reading.power(power)).collect());
        }
        if self.rest.starts_with('1') {
            self.rest = &self.rest[1..];
            return Ok(vec![ONE]);
        }
        self.word()
    }

    fn word(&mut self) -> Result<Vec<Reading>, UnitError> {
        let end = self
            .rest
            .find(|c: char| !(c.is_alphabetic() || c == '°' || c == '%'))
            .unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        if word.is_empty() {
            return Err(self.syntax());
        }
        self.rest = rest;
        let power = self.power()?.unwrap_or(1);
        let readings = word_readings(word, power);
        if readings.is_empty() {
            let nearest = catalog::nearest(word);
            return Err(UnitError::Unknown { word: word.to_owned(), nearest });
        }
        Ok(readings)
    }

    fn power(&mut self) -> Result<Option<i8>, UnitError> {
        let marked = self.take(&["^", "**"]);
        let mut digits = String::new();
        for c in self.rest.chars() {
            match plain_digit(c) {
                Some('-') if !digits.is_empty() => break,
                Some('-') if !marked && c == '-' => break,
                Some(digit) => digits.push(digit),
                None => break,
            }
        }
        let read: usize = self.rest.chars().take(digits.chars().count()).map(char::len_utf8).sum();
        if digits.is_empty() {
            return if marked { Err(self.syntax()) } else { Ok(None) };
        }
        let power = digits.parse::<i8>().map_err(|_| self.syntax())?;
        self.rest = &self.rest[read..];
        Ok(Some(power))
    }
}

/// A digit or minus sign in plain or superscript form.
fn plain_digit(c: char) -> Option<char> {
    const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    match c {
        '0'..='9' | '-' => Some(c),
        '⁻' | '−' => Some('-'),
        _ => SUPERSCRIPTS.chars().position(|s| s == c).and_then(|digit| {
            u32::try_from(digit).ok().and_then(|digit| char::from_digit(digit, 10))
        }),
    }
}

fn combine(left: &[Reading], right: &[Reading], sign: i8) -> Vec<Reading> {
    let pairs = left.iter().flat_map(|a| right.iter().map(move |b| a.times(*b, sign)));
    distinct(pairs.take(MOST_READINGS))
}

fn distinct(readings: impl Iterator<Item = Reading>) -> Vec<Reading> {
    let mut kept: Vec<Reading> = Vec::new();
    for reading in readings {
        if !kept.contains(&reading) {
            kept.push(reading);
        }
    }
    kept
}

/// Readings of a word whose last unit carries `power` ("kgm" in "kgm2" is kg·m²).
fn word_readings(word: &str, power: i8) -> Vec<Reading> {
    let mut readings: Vec<Reading> = catalog::readings(word)
        .map(|(factor, dimension)| Reading { factor, dimension }.power(power))
        .collect();
    if word.len() > LONGEST_COMPOUND {
        return readings;
    }
    for (at, _) in word.char_indices().skip(1) {
        let (head, tail) = word.split_at(at);
        for (factor, dimension) in catalog::readings(head) {
            let head = Reading { factor, dimension };
            readings.extend(word_readings(tail, power).iter().map(|tail| head.times(*tail, 1)));
        }
    }
    distinct(readings.into_iter().take(MOST_READINGS))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn has(text: &str, factor: f64, dimension: Dimension) -> bool {
        read(text).is_ok_and(|readings| {
            readings.iter().any(|r| {
                r.dimension == dimension && (r.factor - factor).abs() <= 1e-14 * factor.abs()
            })
        })
    }

    // Source: unit definitions.
    #[test]
    fn spellings_of_one_unit_agree() {
        let stiffness = Dimension::TORQUE - Dimension::ANGLE;
        for text in ["N·m/rad", "N*m/rad", "Nm/rad", "N m / rad", "N⋅m·rad⁻¹", "N.m/rad", "J/rad"]
        {
            assert!(has(text, 1.0, stiffness), "{text}");
        }
        let inertia = Dimension::new(2, 1, 0, 0);
        for text in ["kg·m²", "kgm2", "kg*m^2", "kgm²", "kg m**2", "kg·m^2"] {
            assert!(has(text, 1.0, inertia), "{text}");
        }
        for text in ["kg·cm²", "kgcm2", "kg*cm^2"] {
            assert!(has(text, 1e-4, inertia), "{text}");
        }
        assert!(has("lbf·ft", 1.355_817_948_331_400_4, Dimension::TORQUE));
        for text in ["lbf-ft", "lb-ft", "lb·ft", "ft-lb"] {
            assert!(has(text, 1.355_817_948_331_400_4, Dimension::TORQUE), "{text}");
        }
        assert!(has("lb·ft²", 0.453_592_37 * 0.304_8 * 0.304_8, inertia));
        assert!(has("N·m/rad³", 1.0, Dimension::TORQUE - Dimension::ANGLE * 3));
        assert!(has("N·m/(rad/s)", 1.0, Dimension::new(2, 1, -1, -1)));
        assert!(has("rev/min", std::f64::consts::PI / 30.0, Dimension::SPEED));
    }

    #[test]
    fn words_with_two_readings_keep_both() {
        assert!(has("Nms", 1.0, Dimension::TORQUE + Dimension::TIME));
        assert!(has("Nms", 1e-3, Dimension::FORCE + Dimension::TIME));
    }

    #[test]
    fn what_is_no_unit_is_refused() {
        assert_eq!(
            read("N·m/rda"),
            Err(UnitError::Unknown { word: "rda".to_owned(), nearest: Some("rad".to_owned()) })
        );
        for text in ["", "/", "N·", "(N", "N)", "N^", "N^x", "m^999", &"(".repeat(40)] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
