//! Numbers in messages.

use std::fmt;

/// A number as messages show it, exact and short: 0, 800, 0.5; 1.5e-6 below 1e-3 and from 1e5 on.
pub(crate) struct Short(f64);

/// See [`Short`]. By reference, too, as messages of errors have their values.
pub(crate) fn short(value: impl std::borrow::Borrow<f64>) -> Short {
    Short(*value.borrow())
}

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        // so that -0 is 0
        if value == 0.0 {
            f.write_str("0")
        } else if (1e-3..1e5).contains(&value.abs()) {
            fmt::Display::fmt(&value, f)
        } else {
            fmt::LowerExp::fmt(&value, f)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_have_an_exponent_only_far_from_1() {
        let values = [0.0, -0.0, 1.0, 800.0, -0.5, 1e-3, 99_999.5, 1e5, 1.5e-6, -1e60, f64::NAN];
        let shown = values.map(|value| short(value).to_string());
        let expected = ["0", "0", "1", "800", "-0.5", "0.001", "99999.5", "1e5", "1.5e-6", "-1e60", "NaN"];
        assert_eq!(shown, expected);
    }
}
