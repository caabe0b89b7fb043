//! Numbers as people read them.

/// `1 gap`, `2 gaps`.
pub(super) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// `once`, `2 times`.
pub(super) fn times(count: usize) -> String {
    if count == 1 { "once".to_owned() } else { format!("{count} times") }
}

/// A share in per cent, never rounded to nothing.
pub(super) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent >= 1.0 { format!("{percent:.0} %") } else { format!("{} %", number(percent)) }
}

/// A blank and the unit, where there is one.
pub(super) fn of_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// A number to three or four figures.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if (1000.0..1e9).contains(&size) {
        return format!("{value:.0}");
    }
    if size != 0.0 && !(1e-4..1e9).contains(&size) {
        return format!("{value:.2e}");
    }
    let digits = (2 - size.max(1e-300).log10().floor() as i32).clamp(0, 8) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        let cases = [
            (0.0, "0"),
            (0.02, "0.02"),
            (-0.2283, "-0.228"),
            (3.0, "3"),
            (12.345, "12.3"),
            (65_516.2, "65516"),
            (1e-6, "1.00e-6"),
            (5e12, "5.00e12"),
            (0.026, "0.026"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
        assert_eq!((percent(0.231).as_str(), percent(0.0004).as_str()), ("23 %", "0.04 %"));
    }
}
