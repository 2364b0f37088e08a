//! Communication points.

use super::refusal::{Checked, Refusal};
use serde::{Deserialize, Serialize};

/// Two times are the same when they differ by less than this, relative to the larger of the time
/// and the longest step so far: masters add up step sizes, and their sums differ in the last
/// digits, also where they come back to 0.
const SAME: f64 = 1e-9;

/// Or by less than this, relative to the step: some masters round their clock to nanoseconds or to
/// single precision. 16,000 equal steps of a clock in single precision stay within it; a step that
/// is repeated or left out is far from it.
const SAME_OF_STEP: f64 = 1e-3;

/// The present time of an instance, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Clock {
    time: f64,
    /// That of this instance's experiment. A saved state has none: what it starts may end at
    /// another time.
    #[serde(skip)]
    stop: Option<f64>,
    /// The longest step so far.
    longest: f64,
    /// The last step that had a length.
    last: f64,
}

impl Default for Clock {
    fn default() -> Self {
        Self { time: 0.0, stop: None, longest: 0.0, last: 0.0 }
    }
}

impl Clock {
    /// The clock of an experiment that starts at `time` and may not pass `stop`.
    pub(super) fn new(time: f64, stop: Option<f64>) -> Checked<Self> {
        if !time.is_finite() {
            return Err(Refusal::Argument {
                argument: "startTime",
                value: time,
                requirement: "a time is finite",
            }
            .into());
        }
        if let Some(value) = stop.filter(|stop| !(stop.is_finite() && *stop >= time)) {
            let requirement = "a stop time is finite and not before the start time";
            return Err(Refusal::Argument { argument: "stopTime", value, requirement }.into());
        }
        Ok(Self { time, stop, longest: 0.0, last: 0.0 })
    }

    /// This clock in the experiment of another.
    pub(super) fn in_experiment_of(self, other: &Self) -> Self {
        Self { stop: other.stop, ..self }
    }

    /// Whether it could have come from steps.
    pub(super) fn is_sound(&self) -> bool {
        let is_length = |length: f64| (0.0..f64::INFINITY).contains(&length);
        is_length(self.longest) && is_length(self.last) && self.time.is_finite()
    }

    /// End of the last step.
    pub(super) fn time(&self) -> f64 {
        self.time
    }

    /// The clock after a step of `length` from `point`.
    #[inline]
    pub(super) fn after(&self, point: f64, length: f64) -> Checked<Self> {
        if !(0.0..=f64::MAX).contains(&length) {
            return Err(negative_or_infinite(length));
        }
        if point != self.time {
            self.check_point(point, length)?;
        }
        let time = point + length;
        if let Some(stop) = self.stop
            && time > stop
        {
            self.check_stop(point, length, stop)?;
        }
        if time > f64::MAX {
            return Err(negative_or_infinite(time));
        }
        let longest = if length > self.longest { length } else { self.longest };
        Ok(Self { time, stop: self.stop, longest, last: if length > 0.0 { length } else { self.last } })
    }

    /// What rounding may do to a time.
    fn slack(&self, time: f64, length: f64) -> f64 {
        let of_time = SAME * time.abs().max(length).max(self.longest);
        of_time.max(SAME_OF_STEP * length.max(self.last))
    }

    /// Refuses a step that passes the stop time by more than rounding.
    #[cold]
    fn check_stop(&self, point: f64, length: f64, stop: f64) -> Checked {
        if point + length > stop + self.slack(stop, length) {
            return Err(Refusal::BeyondStopTime { from: point, length, stop }.into());
        }
        Ok(())
    }

    /// Refuses a communication point that differs from the end of the last step by more than
    /// rounding.
    #[cold]
    fn check_point(&self, point: f64, length: f64) -> Checked {
        // written so that it also refuses a point that is not a number
        if (point - self.time).abs() <= self.slack(point, length) && point.is_finite() {
            return Ok(());
        }
        Err(Refusal::CommunicationPoint { given: point, expected: self.time }.into())
    }
}

#[cold]
fn negative_or_infinite(length: f64) -> Box<Refusal> {
    let requirement = "a step is finite and not negative";
    Refusal::Argument { argument: "communicationStepSize", value: length, requirement }.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digits_of_a_communication_point_do_not_matter() {
        // 0.1 added a hundred times is 9.99999999999998, not 10.
        let mut clock = Clock::new(0.0, Some(10.0)).unwrap();
        for i in 0..100 {
            clock = clock.after(f64::from(i) * 0.1, 0.1).unwrap();
        }
        assert!(clock.after(10.0, 0.0).is_ok());
        assert!(
            clock.after(10.0, 1e-3).is_err_and(|refusal| matches!(*refusal, Refusal::BeyondStopTime { .. }))
        );
    }

    #[test]
    fn wrong_points_and_steps_are_refused() {
        let clock = Clock::new(1.0, None).unwrap();
        for point in [0.0, 1.001, -1.0, f64::NAN, f64::INFINITY] {
            assert!(
                clock
                    .after(point, 0.1)
                    .is_err_and(|refusal| matches!(*refusal, Refusal::CommunicationPoint { .. })),
                "{point}"
            );
        }
        for length in [-1e-3, f64::NAN, f64::INFINITY] {
            assert!(
                clock.after(1.0, length).is_err_and(|refusal| matches!(*refusal, Refusal::Argument { .. })),
                "{length}"
            );
        }
        assert_eq!(clock.after(1.0, 0.0).unwrap(), clock);
    }

    /// 0.1 + 0.1 + 0.1 − 0.3 is 5.6e-17: the end of an experiment at 0 that began at −0.3.
    #[test]
    fn rounding_does_not_matter_next_to_zero_either() {
        let mut clock = Clock::new(-0.3, Some(0.0)).unwrap();
        let mut time = -0.3;
        for _ in 0..3 {
            clock = clock.after(time, 0.1).unwrap();
            time += 0.1;
        }
        assert!(time > 0.0 && clock.is_sound());
        assert!(clock.after(0.0, 0.0).is_ok() && clock.after(time, 0.0).is_ok());
        assert!(clock.after(1e-3, 0.0).is_err() && clock.after(time, 1e-3).is_err());
    }

    /// A step is repeated, shortened and taken up again from the time that it came to.
    #[test]
    fn steps_of_any_length_add_up() {
        let mut clock = Clock::new(0.0, Some(1.0)).unwrap();
        let (mut time, mut length) = (0.0, 0.3);
        while time < 1.0 {
            clock = clock.after(time, f64::min(length, 1.0 - time)).unwrap();
            time += f64::min(length, 1.0 - time);
            length *= 0.7;
            if length < 1e-12 {
                length = 1.0;
            }
        }
        assert_eq!(clock.time(), 1.0);
        assert!(Clock::new(f64::MAX, None).unwrap().after(f64::MAX, f64::MAX).is_err());
    }

    #[test]
    fn an_experiment_has_a_finite_start_and_a_later_stop() {
        assert!(Clock::new(f64::NAN, None).is_err());
        assert!(Clock::new(1.0, Some(0.5)).is_err());
        assert!(Clock::new(1.0, Some(f64::NAN)).is_err());
        assert!(Clock::new(-1.0, Some(-1.0)).is_ok());
    }
}
