//! Roots of functions of one variable, each with what it needs of the function and what it
//! guarantees. All of them end: the number of steps is bounded.

/// Most steps of [`of_rising`]; halving the interval alone needs 60 from ends of one magnitude.
const MOST_STEPS: u32 = 200;

/// Most steps of [`from_below`].
const MOST_PASSES: u32 = 50;

/// The part of a value below which a step of [`from_below`] counts as none.
const ROUNDING: f64 = 1e-14;

/// The root of a rising function in [low, high] by Newton's method, kept inside the interval by
/// bisection; `f` returns value and slope. The slope only makes it fast: it may be of no use, as at
/// a step. The result is good to two units in the last place of x; an end, where there is no root.
pub(crate) fn of_rising(mut low: f64, mut high: f64, f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut x = 0.5 * (low + high);
    for _ in 0..MOST_STEPS {
        let (value, slope) = f(x);
        if value == 0.0 {
            return x;
        }
        if value > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * f64::EPSILON * x.abs() || high - low <= 2.0 * f64::EPSILON * high {
            return next;
        }
        x = next;
    }
    x
}

/// The root of a concave, falling function from a place below it. `step` returns the step of
/// Newton's method, −f/f′ with any slope that is at least as steep: so no step goes beyond the
/// root, and the search ends when one is lost in rounding.
pub(crate) fn from_below(mut value: f64, mut step: impl FnMut(f64) -> f64) -> f64 {
    for _ in 0..MOST_PASSES {
        let next = value + step(value);
        let moves = next > value * (1.0 + ROUNDING);
        if !moves {
            break;
        }
        value = next;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_to_rounding_also_where_newton_would_leave_the_interval() {
        let cubic = of_rising(0.0, 10.0, |x| (x * x * x - 2.0, 3.0 * x * x));
        assert!((cubic - 2f64.cbrt()).abs() < 4.0 * f64::EPSILON);
        // almost a step: the slope is of no use except at the root itself
        let step = of_rising(0.0, 1.0, |x| ((1e4 * (x - 0.3)).tanh() + 0.5, 0.0));
        assert!((step - (0.3 + (-0.5f64).atanh() / 1e4)).abs() < 1e-14, "{step}");
        assert_eq!(of_rising(0.0, 1.0, |x| (x - 0.5, 1.0)), 0.5);
        // a root at either end
        assert!(of_rising(0.0, 1.0, |x| (x, 1.0)).abs() < 1e-50);
        assert!((of_rising(0.0, 1.0, |x| (x - 1.0, 1.0)) - 1.0).abs() < 4.0 * f64::EPSILON);
    }

    /// 1 + x − x² is concave, falls from x = ½ on, and has the root (1 + √5)/2.
    #[test]
    fn steps_from_below_never_pass_the_root() {
        let exact = 0.5 * (1.0 + 5f64.sqrt());
        let mut most = 0.0_f64;
        let root = from_below(1.0, |x| {
            most = most.max(x);
            // the slope at 2, steeper than at any place before the root
            (1.0 + x - x * x) / 3.0
        });
        assert!(most <= exact * (1.0 + 1e-15), "{most}");
        assert!((root / exact - 1.0).abs() < 1e-13, "{root}");
        assert_eq!(from_below(2.0, |x| 1.0 - x), 2.0, "a place beyond the root stays");
    }
}
