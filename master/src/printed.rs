//! Text on its way to a terminal: names and messages of files and FMUs must not command it.

use std::borrow::Cow;

/// With control characters, but for ends of lines and tabs, written out: `\u{1b}` for an escape.
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c.is_control() && c != '\n' && c != '\t')
}

/// With ends of lines written out, too: for what is to stand in one.
pub fn one_line(text: &str) -> Cow<'_, str> {
    escaped(text, char::is_control)
}

fn escaped(text: &str, odd: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&odd) {
        return text.into();
    }
    let written = |c: char| if odd(c) { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(written).collect::<String>().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_written_out() {
        assert_eq!(printable("λ = 1\tN\n\u{1b}[31mred\u{7}"), "λ = 1\tN\n\\u{1b}[31mred\\u{7}");
        assert_eq!(one_line("a\nttb: fine"), "a\\nttb: fine");
        assert!(matches!(printable("plain"), Cow::Borrowed(_)));
    }
}
