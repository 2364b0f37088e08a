//! Where the contacts of an interface are, and the file that lists them.

use crate::error::Error;
use crate::number::short;
use crate::profile::{LengthUnit, SECOND_HEADER, are_words, fields, lines, shorten};
use crate::range;
use serde::{Deserialize, Serialize};

/// One contact of an [`crate::Interface`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Summit {
    /// Gap of this contact at approach 0, m: it touches where the approach reaches its offset.
    pub offset: f64,
    /// Place along the direction of `tangential_displacement`, m, from the axis of rotation.
    pub x: f64,
    /// Place at right angles to it, m.
    pub y: f64,
    /// All lengths of its profile over those of the profile in the parameters:
    /// [`crate::Profile::scaled`]. On a parabola it is the factor of the radius.
    pub radius_factor: f64,
}

impl Summit {
    /// Most contacts of an interface.
    pub const MOST: usize = 10_000_000;

    /// A contact on the axis of rotation with the profile of the parameters.
    pub const fn at_offset(offset: f64) -> Self {
        Self { offset, x: 0.0, y: 0.0, radius_factor: 1.0 }
    }

    /// Displacement of this contact, m, where the body is displaced and turned by an angle (rad)
    /// that is small enough to count to first order.
    pub(crate) fn displacement(&self, [x, y]: [f64; 2], rotation: f64) -> [f64; 2] {
        if rotation == 0.0 {
            return [x, y];
        }
        [x - rotation * self.y, y + rotation * self.x]
    }

    /// Reads a table with one contact in each line: its offset, or offset, x and y, or these and
    /// the radius factor, in the given unit except for the factor. Separators, decimal commas,
    /// comments and a header are as in [`crate::ProfileTable::parse_in`].
    ///
    /// ```
    /// use fretting_contact::{LengthUnit, Summit};
    ///
    /// let table = "offset x y factor\n0 1 0 1\n0.5 -1 0 1.5  # a blunter one\n";
    /// let summits = Summit::parse(table, LengthUnit::Um)?;
    /// assert_eq!(summits[1], Summit { offset: 5e-7, x: -1e-6, y: 0.0, radius_factor: 1.5 });
    /// # Ok::<(), fretting_contact::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::ContactsTable`] that quotes the line.
    pub fn parse(text: &str, unit: LengthUnit) -> Result<Vec<Self>, Error> {
        let mut summits = Vec::new();
        let mut header_allowed = true;
        for (index, line) in lines(text).enumerate() {
            let fields = fields(line.split('#').next().unwrap_or_default());
            if fields.is_empty() {
                continue;
            }
            let is_words = are_words(&fields);
            if is_words && header_allowed {
                header_allowed = false;
                continue;
            }
            let place = || format!("line {}, \"{}\"", index + 1, shorten(line.trim(), 60));
            if is_words && summits.is_empty() {
                return Err(Error::ContactsTable { place: place(), problem: SECOND_HEADER.into() });
            }
            header_allowed = false;
            let summit =
                Self::of_fields(&fields, unit).and_then(|summit| summit.problem().map_or(Ok(summit), Err));
            summits.push(summit.map_err(|problem| Error::ContactsTable { place: place(), problem })?);
        }
        Self::check_number(summits.len())?;
        Ok(summits)
    }

    fn of_fields(fields: &[String], unit: LengthUnit) -> Result<Self, String> {
        const NAMES: [&str; 4] = ["offset", "x", "y", "the radius factor"];
        let symbol = unit.symbol();
        if !matches!(fields.len(), 1 | 3 | 4) {
            return Err(format!(
                "{} column(s), but 1, 3 or 4 are allowed: offset, x and y, in {symbol}, and the radius factor; with decimal \
                 commas separate them by ; or tab",
                fields.len()
            ));
        }
        let mut numbers = [0.0, 0.0, 0.0, 1.0];
        for ((number, field), name) in numbers.iter_mut().zip(fields).zip(NAMES) {
            *number = field.parse().map_err(|_| {
                let unit = if name == NAMES[3] { "a number".into() } else { format!("it in {symbol}") };
                format!("`{}` is not a number: it is {name}, give {unit}", shorten(field, 24))
            })?;
        }
        let [offset, x, y] = [0, 1, 2].map(|k| unit.to_metres(numbers[k]));
        Ok(Self { offset, x, y, radius_factor: numbers[3] })
    }

    /// What is wrong with it.
    pub(crate) fn problem(&self) -> Option<String> {
        let most = *range::LENGTH.end();
        for (name, value) in [("offset", self.offset), ("x", self.x), ("y", self.y)] {
            let within = value.abs() <= most;
            if !within {
                return Some(format!(
                    "{name} = {value:?} m: it has to be finite, {most} m at most",
                    most = short(most)
                ));
            }
        }
        let factor = self.radius_factor;
        (!range::LENGTH.contains(&factor)).then(|| {
            format!("radius factor = {factor:?}: it lies in 1e-30 to 1e30; 1 is the profile as given")
        })
    }

    /// Refuses a number of contacts.
    pub(crate) fn check_number(number: usize) -> Result<(), Error> {
        let place = "the whole table".into();
        let problem = match number {
            0 => "it has no contact: give one line for each, with its offset at least".into(),
            1..=Self::MOST => return Ok(()),
            _ => format!("{number} contacts where {} are the most", Self::MOST),
        };
        Err(Error::ContactsTable { place, problem })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_units_and_comments_are_read() {
        let two = [Summit::at_offset(0.0), Summit { offset: 2.5e-7, x: 1e-3, y: -2e-3, radius_factor: 0.5 }];
        for text in [
            "0 0 0\n0.25 1000 -2000 0.5\n",
            "\u{feff}offset;x;y;factor\n0;0;0;1\n0,25;1000;-2000;0,5\n",
            "offset\tx\ty\tfactor\r0\t0\t0\t1\r0,25\t1000\t-2000\t0,5\r",
            "# two summits\n0\n\n0.25, 1000, -2000, 0.5 # the lower one\n",
        ] {
            assert_eq!(Summit::parse(text, LengthUnit::Um), Ok(two.to_vec()), "{text:?}");
        }
    }

    #[test]
    fn messages_quote_line_value_and_what_is_allowed() {
        for (text, parts) in [
            ("offset\num\n0\n", ["line 2, \"um\"", SECOND_HEADER]),
            ("0.0um\n0.5\n", ["line 1, \"0.0um\"", "`0.0um` is not a number: it is offset, give it in um"]),
            ("--\n0.5\n", ["line 1, \"--\"", "`--` is not a number"]),
            ("1e-6D\n0.5\n", ["line 1, \"1e-6D\"", "`1e-6D` is not a number"]),
            ("0\nhigh\n", ["line 2, \"high\"", "`high` is not a number: it is offset, give it in um"]),
            ("0 0 0 wide\n", ["line 1, \"0 0 0 wide\"", "it is the radius factor, give a number"]),
            ("0 1\n", ["line 1, \"0 1\"", "2 column(s), but 1, 3 or 4"]),
            ("0\n1e40\n", ["line 2, \"1e40\"", "m: it has to be finite, 1e30 m at most"]),
            ("0 nan 0\n", ["line 1, \"0 nan 0\"", "x = NaN m"]),
            ("0 0 0 -1\n", ["line 1, \"0 0 0 -1\"", "radius factor = -1.0: it lies in"]),
            ("# none\n", ["the whole table", "it has no contact"]),
        ] {
            let message = Summit::parse(text, LengthUnit::Um).unwrap_err().to_string();
            assert!(parts.iter().all(|part| message.contains(part)), "{text:?}: {message}");
        }
    }

    #[test]
    fn a_rotation_turns_a_place_about_the_axis() {
        let summit = Summit { x: 3.0, y: 4.0, ..Summit::at_offset(0.0) };
        assert_eq!(summit.displacement([1.0, 2.0], 0.5), [1.0 - 2.0, 2.0 + 1.5]);
    }
}
