//! Profile files: two columns of numbers as instruments and spreadsheets write them.
//!
//! The same rules are in `python/fretting_contact/text_table.py`.

use crate::error::Error;
use serde::{Deserialize, Serialize};

/// Unit of the two columns of a profile file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LengthUnit {
    /// Metres.
    #[default]
    M,
    /// Millimetres.
    Mm,
    /// Micrometres.
    Um,
}

impl LengthUnit {
    /// `value` of this unit in m.
    pub fn to_metres(self, value: f64) -> f64 {
        // 0.1 mm / 1e3 is the number that 1e-4 is read as; 0.1 mm * 1e-3 is not
        match self {
            Self::M => value,
            Self::Mm => value / 1e3,
            Self::Um => value / 1e6,
        }
    }

    /// Symbol for messages.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::M => "m",
            Self::Mm => "mm",
            Self::Um => "um",
        }
    }
}

/// The points of a file, m, and the places that they stand at.
#[derive(Debug, Default)]
pub(super) struct Points {
    pub(super) points: Vec<(f64, f64)>,
    pub(super) places: Vec<String>,
}

/// What is wrong with a second line of words before the numbers.
pub(crate) const SECOND_HEADER: &str =
    "a second line of words, but one header line is skipped: delete it, or write # before it";

/// Whether these fields are a header: words with a letter among them. A number with its unit is no
/// word, nor is one that cannot be read for another reason.
pub(crate) fn are_words(fields: &[String]) -> bool {
    let is_word = |field: &String| {
        let begin = field.trim_start_matches(['"', '\'', '(', '[', '+', '-', '.']);
        field.parse::<f64>().is_err() && !begin.starts_with(|first: char| first.is_ascii_digit())
    };
    fields.iter().all(is_word) && fields.iter().any(|field| field.contains(char::is_alphabetic))
}

/// Reads r and f, m, in the order of the file or reversed if r falls. `#` starts a comment. One
/// header line of words is skipped.
///
/// # Errors
/// [`Error::ProfileTable`] that quotes the line.
pub(super) fn read(text: &str, unit: LengthUnit) -> Result<Points, Error> {
    let Points { mut points, mut places } = Points::default();
    let mut header_allowed = true;
    for (index, line) in lines(text).enumerate() {
        let fields = fields(line.split('#').next().unwrap_or_default());
        let numbers: Vec<_> = fields.iter().map(|field| field.parse::<f64>().ok()).collect();
        if fields.is_empty() {
            continue;
        }
        let is_header = header_allowed && are_words(&fields);
        header_allowed = false;
        if is_header {
            continue;
        }
        let place = format!("line {}, \"{}\"", index + 1, shorten(line.trim(), 60));
        let unit_name = unit.symbol();
        let problem = match numbers[..] {
            [Some(r), Some(f)] => {
                points.push((unit.to_metres(r), unit.to_metres(f)));
                places.push(place);
                continue;
            }
            _ if points.is_empty() && are_words(&fields) => SECOND_HEADER.into(),
            [None, _] | [_, None] => {
                let (field, name) = if numbers[0].is_none() { (&fields[0], "r") } else { (&fields[1], "f") };
                format!("`{}` is not a number: give {name} in {unit_name}", shorten(field, 24))
            }
            _ => format!(
                "{} column(s), but two are needed: r and f, in {unit_name}; with decimal commas separate them by ; or tab",
                fields.len()
            ),
        };
        return Err(Error::ProfileTable { place, problem });
    }
    if let ([(first, _), ..], Some((last, _))) = (&points[..], points.last())
        && first > last
    {
        points.reverse();
        places.reverse();
    }
    Ok(Points { points, places })
}

/// The lines of a text without its byte-order mark; LF, CRLF or CR alone ends a line.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = &str> {
    let lines = text.trim_start_matches('\u{feff}').split('\n');
    lines.flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'))
}

/// The fields of a line: `;` separates before tab, and tab before blanks and commas.
pub(crate) fn fields(content: &str) -> Vec<String> {
    match [';', '\t'].into_iter().find(|separator| content.trim().contains(*separator)) {
        // with these separators a comma is a decimal comma
        Some(separator) => content
            .split(separator)
            .map(|field| field.trim().trim_end_matches(',').replacen(',', ".", 1))
            .filter(|field| !field.is_empty())
            .collect(),
        None => content
            .split(|c: char| c.is_whitespace() || c == ',')
            .filter(|field| !field.is_empty())
            .map(str::to_owned)
            .collect(),
    }
}

/// The start of a text for a message.
pub(crate) fn shorten(text: &str, length: usize) -> String {
    let start: String = text.chars().take(length).collect();
    if start.len() < text.len() { format!("{start}…") } else { start }
}

#[cfg(test)]
mod tests {
    use super::*;
    use LengthUnit::{M, Mm, Um};

    const SPHERE: [(f64, f64); 3] = [(0.0, 0.0), (1e-4, 5e-7), (2e-4, 2e-6)];

    #[test]
    fn files_as_instruments_write_them() {
        for (text, unit) in [
            ("0 0\n1e-4 5e-7\n2e-4 2e-6\n", M),
            ("\u{feff}0 0\r\n1e-4 5e-7\r\n2e-4 2e-6\r\n", M),
            ("r f\r0 0\r1e-4 5e-7\r2e-4 2e-6\r", M),
            ("# a comment\n\nradius height\n0 0\n1e-4 5e-7\n2e-4 2e-6", M),
            ("r [mm] f (-)\n0 0\n1e-4 5e-7\n", M),
            ("x [\u{fffd}m];z\n0;0\n0,1;0,0005\n0,2;0,002\n", Mm),
            ("Radius\tHeight\n0\t0\n100,0\t0,5\n200,0\t2,0\n", Um),
            ("0,1\t5e-4\n0\t0\n", Mm),
            ("0.2 0.002\n0.1 0.0005 # falling\n0 0\n", Mm),
            ("0,0\n0.1,0.0005\n0.2,0.002\n", Mm),
            ("0,\t0\n0.1,\t0.0005\n0.2,\t0.002\n", Mm),
        ] {
            let found = read(text, unit).unwrap_or_else(|error| panic!("{text:?}: {error}")).points;
            assert_eq!(found, SPHERE[..found.len()], "{text:?}");
        }
    }

    #[test]
    fn messages_quote_the_line() {
        for (text, parts) in [
            ("r f\nr f\n0 0\n", ["line 2, \"r f\"", SECOND_HEADER]),
            ("r f\n0 0\nr f\n", ["line 3, \"r f\"", "`r` is not a number: give r in mm"]),
            ("0 0\r\n\r\n1e-4 high\r\n", ["line 3, \"1e-4 high\"", "`high` is not a number: give f in mm"]),
            ("0 0\r\r1e-4 high\r", ["line 3, \"1e-4 high\"", "`high` is not a number: give f in mm"]),
            ("0 0\n1e-4 high\n", ["line 2, \"1e-4 high\"", "`high` is not a number: give f in mm"]),
            ("0mm 0mm\n1e-4 5e-7\n", ["line 1, \"0mm 0mm\"", "`0mm` is not a number: give r in mm"]),
            ("\"0\",\"0\"\n", ["line 1", "is not a number: give r in mm"]),
            ("0,1 0,2\n", ["line 1, \"0,1 0,2\"", "4 column(s)"]),
            ("0;0\n1.234,5;2\n", ["line 2, \"1.234,5;2\"", "`1.234.5` is not a number"]),
        ] {
            let message = read(text, Mm).unwrap_err().to_string();
            assert!(parts.iter().all(|part| message.contains(part)), "{text:?}: {message}");
        }
    }
}
