//! Bisection to the last bit: slow, and cannot fail on a bracket.

/// The root of `f` between `low` and `high`, to neighbouring floating-point numbers.
///
/// # Panics
/// If f has the same strict sign at both ends.
pub fn bisect(mut low: f64, mut high: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let (at_low, at_high) = (f(low), f(high));
    assert!(at_low * at_high <= 0.0, "no change of sign: f({low:e}) = {at_low:e}, f({high:e}) = {at_high:e}");
    if at_low == 0.0 {
        return low;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if (f(middle) < 0.0) == (at_low < 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_is_found_to_the_last_bit_whatever_the_direction() {
        let exact = 2f64.sqrt();
        for sign in [1.0, -1.0] {
            let root = bisect(0.0, 2.0, |x| sign * (x * x - 2.0));
            assert!((root - exact).abs() <= 2.0 * f64::EPSILON);
        }
        assert_eq!(bisect(0.0, 1.0, |x| x), 0.0);
        assert_eq!(bisect(0.0, 1.0, |x| x - 1.0), 1.0);
    }

    #[test]
    #[should_panic(expected = "no change of sign")]
    fn a_bracket_without_a_root_is_refused() {
        bisect(1.0, 2.0, |x| x);
    }
}
