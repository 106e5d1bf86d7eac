//! Text on its way to a terminal: names and messages of files and FMUs must not command it, nor look like something else.

use std::borrow::Cow;

/// With control characters, but for ends of lines and tabs, written out: `\u{1b}` for an escape.
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, |c| misleads(c) && c != '\n' && c != '\t')
}

/// With ends of lines written out, too: for what is to stand in one.
pub fn one_line(text: &str) -> Cow<'_, str> {
    escaped(text, misleads)
}

/// Control characters, ends of lines in Unicode, what is not seen, and what changes the direction of what follows.
fn misleads(c: char) -> bool {
    let unseen = matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}');
    c.is_control() || unseen || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
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
    fn control_characters_and_what_is_not_seen_are_written_out() {
        assert_eq!(printable("λ = 1\tN\n\u{1b}[31mred\u{7}"), "λ = 1\tN\n\\u{1b}[31mred\\u{7}");
        assert_eq!(one_line("a\nttb: fine"), "a\\nttb: fine");
        assert_eq!(
            one_line("\u{9b}2J \u{202e}enif \u{200b}\u{feff}\u{2028}"),
            "\\u{9b}2J \\u{202e}enif \\u{200b}\\u{feff}\\u{2028}"
        );
        assert!(matches!(printable("plain äé 中文"), Cow::Borrowed(_)));
    }
}
