//! Names that users gave, and lists of them.

/// A name in one line: a terminal must not act on it, and a table must not break on it.
pub(crate) fn plain(name: &str) -> String {
    let shown = |c: char| match c {
        '\n' | '\r' | '\t' => ' ',
        c if c.is_control() || is_invisible(c) => char::REPLACEMENT_CHARACTER,
        c => c,
    };
    name.chars().map(shown).collect()
}

/// Characters that turn the reading direction or mark lines.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A name cut to so many characters.
pub(crate) fn short(name: &str, most: usize) -> String {
    let name = plain(name);
    if name.chars().count() <= most {
        return name;
    }
    let kept: String = name.chars().take(most.saturating_sub(1)).collect();
    format!("{}…", kept.trim_end())
}

/// "a", "a and b", "a, b and c".
pub(crate) fn list<T: AsRef<str>>(items: &[T]) -> String {
    let items: Vec<&str> = items.iter().map(AsRef::as_ref).collect();
    match items.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => String::new(),
    }
}

/// "no shaft", "1 shaft", "3 shafts"; small words where the plural needs more than an s.
pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    match count {
        0 => format!("no {many}"),
        1 => format!("one {one}"),
        2..=9 => format!("{} {many}", SMALL[count - 2]),
        _ => format!("{count} {many}"),
    }
}

const SMALL: [&str; 8] = ["two", "three", "four", "five", "six", "seven", "eight", "nine"];

/// A text with a capital at its beginning, unless it begins with a symbol such as `x` or `ω₁`.
pub(crate) fn capital(text: &str) -> String {
    let word = text.split([' ', ',']).next().unwrap_or_default();
    let symbol = word.chars().count() < 2 && word != "a";
    let greek = |c: char| ('\u{370}'..'\u{400}').contains(&c);
    let mut characters = text.chars();
    match characters.next() {
        Some(first) if !symbol && !greek(first) => first.to_uppercase().chain(characters).collect(),
        _ => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::{capital, counted, list, plain, short};

    /// Oracle: by hand.
    #[test]
    fn names_stay_in_their_line() {
        assert_eq!(plain("a\nb\u{1b}[31m"), "a b\u{fffd}[31m");
        assert_eq!(short("gearbox output", 8), "gearbox…");
        assert_eq!(short("gearbox", 8), "gearbox");
    }

    /// Oracle: by hand.
    #[test]
    fn lists_and_counts_read_as_english() {
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
        assert_eq!(list::<&str>(&[]), "");
        assert_eq!(counted(0, "shaft", "shafts"), "no shafts");
        assert_eq!(counted(1, "shaft", "shafts"), "one shaft");
        assert_eq!(counted(9, "shaft", "shafts"), "nine shafts");
        assert_eq!(counted(12, "inertia", "inertias"), "12 inertias");
        assert_eq!(capital("steady"), "Steady");
        assert_eq!(capital("x is the twist"), "x is the twist");
        assert_eq!(capital("ω₁"), "ω₁");
        assert_eq!(capital("a line"), "A line");
    }
}
