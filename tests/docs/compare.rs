//! What a page shows against what comes out: words to the letter, numbers within reason.

use skipping::Outcome;

/// The first line of `shown` that does not come after the ones before it.
pub(crate) fn first_missing<'s>(shown: &'s [String], out: &str) -> Option<&'s str> {
    let mut lines = out.lines();
    let is_told = |line: &&String| !line.trim().is_empty() && line.trim() != "...";
    shown.iter().filter(is_told).find(|line| !lines.any(|there| alike(line, there))).map(String::as_str)
}

/// Whether two lines say the same, blanks aside; a line that ends in `...` stands for all that begin so.
fn alike(shown: &str, there: &str) -> bool {
    let (shown, open) = match shown.trim_end().strip_suffix("...") {
        Some(start) => (start, true),
        None => (shown, false),
    };
    let (a, b) = (tokens(shown), tokens(there));
    let as_long = if open { a.len() <= b.len() } else { a.len() == b.len() };
    as_long && a.iter().zip(&b).all(|(a, b)| a.is(b))
}

#[derive(Debug, PartialEq)]
enum Token<'t> {
    Word(&'t str),
    /// A number, and one in its last digit.
    Number(f64, f64),
}

impl Token<'_> {
    fn is(&self, other: &Self) -> bool {
        match (self, other) {
            // Another processor may round another way, and a search may stop a step later.
            (Self::Number(a, last), Self::Number(b, _)) => (a - b).abs() <= (0.05 * a.abs()).max(2.0 * last),
            _ => self == other,
        }
    }
}

/// Words, numbers and signs of a line.
fn tokens(line: &str) -> Vec<Token<'_>> {
    let mut out = Vec::new();
    let mut rest = line.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let mut end = if is_part(first) { rest.find(|c| !is_part(c)).unwrap_or(rest.len()) } else { first.len_utf8() };
        if rest[..end].bytes().all(|byte| byte.is_ascii_digit()) {
            let fraction = rest[end..].strip_prefix('.').unwrap_or_default();
            let digits = fraction.find(|c: char| !c.is_ascii_digit()).unwrap_or(fraction.len());
            if digits > 0 {
                end += 1 + digits;
            }
            let value = rest[..end].parse().expect("digits");
            out.push(Token::Number(value, 0.1_f64.powf(digits as f64)));
        } else {
            out.push(Token::Word(&rest[..end]));
        }
        rest = rest[end..].trim_start();
    }
    out
}

pub(crate) fn words_to_the_letter_numbers_within_reason() -> Outcome {
    assert!(alike("left  1.112 ± 0.041 N m", "left 1.114 ± 0.043 N m"));
    assert!(alike("run_1   -0.66", "run_1 -0.67") && !alike("run_1 -0.66", "run_1 0.66"));
    assert!(!alike("run_1 0.66", "run_2 0.66") && !alike("1.0 rad", "2.0 rad") && !alike("a b", "a"));
    assert!(alike("Causes ...", "Causes of all") && !alike("Causes ...", "Cause of all"));
    let shown = ["one 1", "...", "three"].map(str::to_owned);
    assert_eq!(first_missing(&shown, "zero\none 1\ntwo\nthree\n"), None);
    assert_eq!(first_missing(&shown, "three\none 1\n"), Some("three"));
    Ok(())
}
