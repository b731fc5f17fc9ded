//! Text broken into lines of a terminal.

/// Columns that a text takes on a terminal.
pub(super) fn columns(text: &str) -> usize {
    text.chars().map(width).sum()
}

/// Columns of a character: two for the wide ones of East Asia and pictures, none for accents that
/// sit on the letter before.
fn width(c: char) -> usize {
    match c {
        '\u{300}'..='\u{36f}' | '\u{200b}'..='\u{200f}' | '\u{fe00}'..='\u{fe0f}' => 0,
        '\u{1100}'..='\u{115f}'
        | '\u{2e80}'..='\u{a4cf}'
        | '\u{ac00}'..='\u{d7a3}'
        | '\u{f900}'..='\u{faff}'
        | '\u{fe30}'..='\u{fe4f}'
        | '\u{ff00}'..='\u{ff60}'
        | '\u{ffe0}'..='\u{ffe6}'
        | '\u{1f300}'..='\u{1faff}'
        | '\u{20000}'..='\u{3fffd}' => 2,
        _ => 1,
    }
}

/// The text in lines no wider than `most` columns. Breaks at spaces, and inside a word only if
/// the word alone is too wide; spaces that must not break become usual ones.
pub(super) fn wrapped(text: &str, most: usize) -> Vec<String> {
    let most = most.max(2);
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split([' ', '\n', '\t']).filter(|word| !word.is_empty()) {
        for piece in pieces(word, most) {
            let joined = columns(&line) + 1 + columns(&piece);
            if !line.is_empty() && joined > most {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(&piece);
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// A word, cut where it alone is too wide.
fn pieces(word: &str, most: usize) -> Vec<String> {
    let mut pieces = vec![String::new()];
    let mut used = 0;
    for c in word.chars() {
        if used + width(c) > most {
            pieces.push(String::new());
            used = 0;
        }
        used += width(c);
        if let Some(piece) = pieces.last_mut() {
            piece.push(if c == '\u{a0}' { ' ' } else { c });
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::{columns, wrapped};
    use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};

    /// Oracle: by hand.
    #[test]
    fn lines_break_at_spaces_that_may_break() {
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(wrapped("carries 7814\u{a0}N·m now", 12), ["carries", "7814 N·m now"]);
        assert_eq!(wrapped("abcdefgh", 3), ["abc", "def", "gh"]);
        assert!(wrapped("  ", 5).is_empty());
        assert_eq!(columns("漢字e\u{301}"), 5);
    }

    proptest! {
        /// Oracle: the contract: no line is wider, and no letter is lost.
        #[test]
        fn no_line_is_too_wide(text in any::<String>(), most in 2_usize..60) {
            let lines = wrapped(&text, most);
            prop_assert!(lines.iter().all(|line| columns(line) <= most));
            let letters = |text: &str| -> String {
                text.chars().filter(|c| !matches!(c, ' ' | '\n' | '\t' | '\u{a0}')).collect()
            };
            prop_assert_eq!(letters(&lines.concat()), letters(&text));
        }
    }
}
