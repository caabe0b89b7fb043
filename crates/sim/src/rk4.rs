//! The classical Runge-Kutta scheme.

/// One step of length `h` (s) of the classical fourth-order Runge-Kutta scheme for `ẋ = rate(x)`.
///
/// Explicit: stable while `h` times the fastest rate stays below 2.78. Slip reaches 10⁴ 1/s at low speed.
#[inline]
#[must_use]
pub fn rk4<const N: usize>(state: &[f64; N], h: f64, rate: impl Fn(&[f64; N]) -> [f64; N]) -> [f64; N] {
    let moved = |k: &[f64; N], h: f64| -> [f64; N] { std::array::from_fn(|i| state[i] + h * k[i]) };
    let k1 = rate(state);
    let k2 = rate(&moved(&k1, 0.5 * h));
    let k3 = rate(&moved(&k2, 0.5 * h));
    let k4 = rate(&moved(&k3, h));
    std::array::from_fn(|i| state[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

#[cfg(test)]
mod tests {
    use super::rk4;

    #[test]
    fn a_circle_is_followed_to_fourth_order() {
        let error = |steps: u32| {
            let h = 1.0 / f64::from(steps);
            let mut s = [1.0, 0.0];
            for _ in 0..steps {
                s = rk4(&s, h, |s| [-s[1], s[0]]);
            }
            (s[0] - 1.0_f64.cos()).hypot(s[1] - 1.0_f64.sin())
        };
        let ratio = error(10) / error(20);
        assert!((ratio - 16.0).abs() < 1.0, "{ratio}");
    }
}
