//! Long texts broken into lines.

use crate::figure::font::{self, Weight};
use crate::figure::typeset::{Level, Rich};

/// The text in lines no wider than `width`, at most `most` of them; what does not fit is replaced
/// by an ellipsis. Breaks at spaces, and inside a word only if the word alone is too wide.
pub(crate) fn wrapped(
    text: &Rich,
    size: f64,
    weight: Weight,
    width: f64,
    most: usize,
) -> Vec<Rich> {
    let measure = |&(c, level): &(char, Level)| font::advance(c, weight) * level.size(size);
    let characters: Vec<(char, Level)> =
        text.runs.iter().flat_map(|run| run.text.chars().map(|c| (c, run.level))).collect();
    let mut lines = Vec::new();
    let mut start = 0;
    while start < characters.len() {
        let fitting = fitting(&characters[start..], width, measure);
        let rest = start + fitting;
        if rest == characters.len() {
            lines.push(line(&characters[start..]));
            break;
        }
        if lines.len() + 1 >= most.max(1) {
            lines.push(shortened(&characters[start..rest], width, measure));
            break;
        }
        let space = |&(c, level): &(char, Level)| c == ' ' && level == Level::Base;
        // A space just after the last character that fits is a break as well.
        let last_space = characters[start..=rest].iter().rposition(space).filter(|&p| p > 0);
        let end = last_space.map_or(rest, |place| start + place);
        lines.push(line(&characters[start..end]));
        start = if last_space.is_some() { end + 1 } else { end };
    }
    lines
}

/// How many characters fit into the width, at least one.
fn fitting(
    characters: &[(char, Level)],
    width: f64,
    measure: impl Fn(&(char, Level)) -> f64,
) -> usize {
    let mut used = 0.0;
    let fits = |character: &&(char, Level)| {
        used += measure(character);
        used <= width
    };
    characters.iter().take_while(fits).count().max(1)
}

fn shortened(
    characters: &[(char, Level)],
    width: f64,
    measure: impl Fn(&(char, Level)) -> f64,
) -> Rich {
    let ellipsis = ('…', Level::Base);
    let room = width - measure(&ellipsis);
    let mut kept = characters[..fitting(characters, room, measure)].to_vec();
    while kept.last().is_some_and(|&(c, _)| c == ' ') {
        kept.pop();
    }
    kept.push(ellipsis);
    line(&kept)
}

fn line(characters: &[(char, Level)]) -> Rich {
    let mut rich = Rich::default();
    for &(c, level) in characters {
        rich.push(c, level);
    }
    rich
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{any, prop_assert, proptest};

    fn lines(text: &str, width: f64, most: usize) -> Vec<String> {
        let text = Rich::parse(text);
        wrapped(&text, 10.0, Weight::Regular, width, most).iter().map(Rich::text).collect()
    }

    /// Oracle: by hand with the published widths: at size 10 a digit is 6.36 wide, a space 3.18.
    #[test]
    fn lines_break_at_spaces() {
        assert_eq!(lines("1111 2222 3333", 60.0, 9), ["1111 2222", "3333"]);
        assert_eq!(lines("1111 2222", 30.0, 9), ["1111", "2222"]);
        assert_eq!(lines("111122223333", 30.0, 9), ["1111", "2222", "3333"]);
        assert_eq!(lines("1111 2222 3333", 30.0, 2), ["1111", "222…"]);
        assert!(lines("", 30.0, 2).is_empty());
    }

    proptest! {
        /// Oracle: the contract: no line too wide unless it is one character (and its ellipsis), and
        /// no more lines than asked for.
        #[test]
        fn lines_keep_to_their_width(text in any::<String>(), width in 0.0..200.0_f64) {
            let found = wrapped(&Rich::parse(&text), 10.0, Weight::Regular, width, 4);
            prop_assert!(found.len() <= 4);
            for line in found {
                let wide = line.width(10.0, Weight::Regular) > width + 1e-9;
                prop_assert!(!wide || line.text().chars().count() <= 2);
            }
        }
    }
}
