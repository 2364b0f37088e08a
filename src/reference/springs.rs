//! The one-dimensional image as a row of springs, moved in small steps: a brute-force check for
//! load histories that no closed form covers.
//!
//! Eq. (13) of Dimaki et al. 2014, spring by spring: a spring in contact follows ΔU until G* abs(u)
//! reaches μq and is then held at ±μq/G*. It enters contact unstressed and forgets its state on
//! leaving. Nothing else is assumed; in particular a straight line in (F_N, U) is walked in
//! sub-steps, not jumped. The error is of second order in the spacing and, for the friction work,
//! in the length of the sub-steps (between first and second where a line passes through F_N = 0).
//! No wear.

use super::shape::Shape;

/// Springs at x = (i + ½)Δx on one half of a symmetric row; forces and work count both halves.
#[derive(Debug, Clone)]
pub struct PlainSpringRow {
    /// g at the springs, m, not decreasing.
    image: Vec<f64>,
    /// Normal force at which each spring just touches, N.
    touch_force: Vec<f64>,
    /// Sum of the first n images, m.
    image_sum: Vec<f64>,
    spacing: f64,
    normal_modulus: f64,
    tangential_modulus: f64,
    friction: f64,
    /// The force last asked for, N: where the next straight line starts; negative while pulled
    /// apart.
    force: f64,
    depth: f64,
    displacement: f64,
    /// u of each spring, m; 0 outside contact.
    deflection: Vec<f64>,
    /// Friction work of each spring per 2 G* Δx, m².
    work: Vec<f64>,
}

/// The quantity that moves evenly during a sub-step, at its two ends: F_N, N, or d, m.
enum Control {
    Force { before: f64, now: f64 },
    Depth { before: f64, now: f64 },
}

impl PlainSpringRow {
    /// A row with the given images (m) at x = (i + ½) `spacing`, bodies apart, U = 0.
    /// `normal_modulus` E* and `tangential_modulus` G* in Pa, `friction` μ. Beyond the last spring
    /// there is nothing: once that one touches, the row is a punch that ends there.
    ///
    /// # Panics
    /// If the images decrease somewhere, or there is none.
    pub fn new(
        image: Vec<f64>,
        spacing: f64,
        normal_modulus: f64,
        tangential_modulus: f64,
        friction: f64,
    ) -> Self {
        assert!(!image.is_empty() && image.is_sorted(), "the images of the springs do not decrease");
        let mut image_sum = Vec::with_capacity(image.len() + 1);
        image_sum.push(0.0);
        image_sum.extend(image.iter().scan(0.0, |sum, g| {
            *sum += g;
            Some(*sum)
        }));
        let count = image.len();
        let stiffness = 2.0 * normal_modulus * spacing;
        let touch_force = (0..count).map(|i| stiffness * (i as f64 * image[i] - image_sum[i])).collect();
        Self {
            touch_force,
            depth: image[0].min(0.0),
            image,
            image_sum,
            spacing,
            normal_modulus,
            tangential_modulus,
            friction,
            force: 0.0,
            displacement: 0.0,
            deflection: vec![0.0; count],
            work: vec![0.0; count],
        }
    }

    /// `count` springs over 0 < x < `length` (m) under a shape; `length` beyond the largest contact
    /// radius, or the radius of the flat punch.
    pub fn under(
        shape: Shape,
        length: f64,
        count: usize,
        normal_modulus: f64,
        tangential_modulus: f64,
        friction: f64,
    ) -> Self {
        let spacing = length / count as f64;
        let image = (0..count).map(|i| shape.image((i as f64 + 0.5) * spacing)).collect();
        Self::new(image, spacing, normal_modulus, tangential_modulus, friction)
    }

    /// Walks the straight line in (F_N, U) to `force` (N) and `displacement` (m) in equal
    /// sub-steps. F_N ≤ 0 means apart.
    pub fn advance(&mut self, force: f64, displacement: f64, substeps: usize) {
        let (from_force, from) = (self.force, self.displacement);
        for k in 1..=substeps {
            let part = k as f64 / substeps as f64;
            let (before, now) = (self.force, from_force + part * (force - from_force));
            let depth = self.depth_at_force(now);
            self.force = now;
            self.substep(Control::Force { before, now }, depth, from + part * (displacement - from));
        }
    }

    /// Walks the straight line in (d, U) to `depth` and `displacement` (both m) in equal sub-steps.
    pub fn advance_at_depth(&mut self, depth: f64, displacement: f64, substeps: usize) {
        let (from_depth, from) = (self.depth, self.displacement);
        for k in 1..=substeps {
            let part = k as f64 / substeps as f64;
            let (before, now) = (self.depth, from_depth + part * (depth - from_depth));
            self.substep(Control::Depth { before, now }, now, from + part * (displacement - from));
            self.force = self.normal_force();
        }
    }

    /// One application of eq. (13) to every spring.
    fn substep(&mut self, control: Control, depth: f64, displacement: f64) {
        let step = displacement - self.displacement;
        let limit_per_depth = self.friction * self.normal_modulus / self.tangential_modulus;
        let depth_before = self.depth;
        // what each spring needs to touch, in the quantity that moves evenly, and its larger value
        // of the two ends
        let (touch, before, now) = match control {
            Control::Force { before, now } => (&self.touch_force, before, now),
            Control::Depth { before, now } => (&self.image, before, now),
        };
        let (most, per_change) = (before.max(now), 1.0 / (now - before).abs());
        let touched = touch.partition_point(|&needed| needed < most);
        let springs = touch.iter().zip(&self.image).zip(&mut self.deflection).zip(&mut self.work);
        for (((needed, g), u), work) in springs.take(touched) {
            // the part of the sub-step in contact: all of it, unless the spring enters or leaves
            // meanwhile
            let share = ((most - needed) * per_change).min(1.0);
            let limit_before = (limit_per_depth * (depth_before - g)).max(0.0);
            let limit = (limit_per_depth * (depth - g)).max(0.0);
            let followed = *u + share * step;
            *u = followed.min(limit).max(-limit);
            // what it did not follow it slid, under the limit force of meanwhile
            *work += 0.5 * (limit_before + limit) * (followed - *u).abs();
        }
        self.depth = depth;
        self.displacement = displacement;
    }

    /// d at which the springs carry `force`, m: from 2E* Δx Σ (d − g) over the n springs with g <
    /// d.
    fn depth_at_force(&self, force: f64) -> f64 {
        let n = self.touch_force.partition_point(|&needed| needed < force);
        if n == 0 {
            return self.image[0];
        }
        (force / (2.0 * self.normal_modulus * self.spacing) + self.image_sum[n]) / n as f64
    }

    fn springs_in_contact(&self) -> usize {
        self.image.partition_point(|&g| g < self.depth)
    }

    /// d, m; the lowest image once a force ≤ 0 has taken the bodies apart, and 0 (or the lowest
    /// image below) at the start.
    pub fn depth(&self) -> f64 {
        self.depth
    }

    /// U, m.
    pub fn displacement(&self) -> f64 {
        self.displacement
    }

    /// F_N, N.
    pub fn normal_force(&self) -> f64 {
        let n = self.springs_in_contact();
        2.0 * self.normal_modulus * self.spacing * (n as f64 * self.depth - self.image_sum[n])
    }

    /// T, N.
    pub fn tangential_force(&self) -> f64 {
        2.0 * self.tangential_modulus * self.spacing * self.deflection.iter().sum::<f64>()
    }

    /// Accumulated friction work, J.
    pub fn friction_work(&self) -> f64 {
        2.0 * self.tangential_modulus * self.spacing * self.work.iter().sum::<f64>()
    }

    /// a, m, from g = d between the last spring in contact and the next; the end of the row if
    /// there is none.
    pub fn contact_radius(&self) -> f64 {
        let n = self.springs_in_contact();
        if n == 0 {
            return 0.0;
        }
        match self.image.get(n) {
            Some(next) => {
                let last = self.image[n - 1];
                (n as f64 - 0.5 + (self.depth - last) / (next - last)) * self.spacing
            }
            None => n as f64 * self.spacing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::normal::NormalContact;
    use crate::reference::shape::tests::SHAPES;
    use crate::reference::tangential::{TangentialContact, oblique_rise};
    use Shape::{BluntedSphere, FlatPunch, Parabola};

    const E_STAR: f64 = 210e9 / (2.0 * (1.0 - 0.09));
    const G_STAR: f64 = 2.0 * 210e9 / 2.6 / 1.7;
    const MU: f64 = 0.6;
    const BALL: Shape = Parabola { radius: 0.01 };

    fn contact(shape: Shape, force: f64) -> TangentialContact {
        let normal = NormalContact::at_force(shape, E_STAR, force);
        TangentialContact { normal, modulus: G_STAR, friction: MU }
    }

    /// A row under `shape` that reaches just beyond the contact at `force`.
    fn row(shape: Shape, force: f64, count: usize) -> PlainSpringRow {
        let reach = match shape {
            FlatPunch { flat_radius } => flat_radius,
            _ => 1.037 * contact(shape, force).normal.radius(),
        };
        PlainSpringRow::under(shape, reach, count, E_STAR, G_STAR, MU)
    }

    fn assert_close(value: f64, exact: f64, tolerance: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(error <= tolerance, "{what}: {value:e} against {exact:e}");
    }

    /// Order of convergence from errors at steps that shrink by `ratio` each.
    fn orders(errors: &[f64], ratio: f64) -> Vec<f64> {
        errors.windows(2).map(|pair| (pair[0] / pair[1]).ln() / ratio.ln()).collect()
    }

    #[test]
    fn loading_and_return_follow_the_closed_forms_for_every_shape() {
        for shape in SHAPES {
            let (exact, mut row) = (contact(shape, 100.0), row(shape, 100.0, 100_000));
            row.advance(100.0, 0.0, 7);
            assert_close(row.normal_force(), 100.0, 1e-9, "F_N");
            assert_close(row.depth() / exact.normal.depth(), 1.0, 1e-7, "d");
            assert_close(row.contact_radius() / exact.normal.radius(), 1.0, 1e-7, "a");
            assert_eq!(row.tangential_force(), 0.0);
            let u = exact.full_slip();
            for theta in [0.3, 0.7, 0.95] {
                row.advance(100.0, theta * u, 3);
                assert_close(
                    row.tangential_force(),
                    exact.loading(theta * u),
                    1e-5,
                    &format!("{shape:?} {theta}"),
                );
            }
            for theta in [0.6, 0.1, -0.5, -0.95] {
                row.advance(100.0, theta * u, 3);
                let back = exact.returning(0.95 * u, theta * u);
                assert_close(row.tangential_force(), back, 1e-5, &format!("{shape:?} back at {theta}"));
            }
        }
    }

    #[test]
    fn the_friction_work_is_that_of_the_loop() {
        for shape in [BALL, BluntedSphere { radius: 0.01, flat_radius: 1e-4 }] {
            let exact = contact(shape, 100.0);
            for theta in [0.25, 0.5, 0.75, 1.0, 1.5] {
                let mut row = row(shape, 100.0, 20_000);
                row.advance(100.0, 0.0, 1);
                let (u, work) = (theta * exact.full_slip(), exact.loop_work(theta * exact.full_slip()));
                row.advance(100.0, u, 1);
                assert_close(row.friction_work() / work, 0.25, 1e-6, "first quarter");
                row.advance(100.0, -u, 1);
                row.advance(100.0, u, 1);
                assert_close(row.friction_work() / work, 1.25, 5e-6, &format!("{shape:?} at {theta}"));
            }
        }
    }

    /// The contact edge falls anywhere in its cell, so that single errors scatter: their mean
    /// square over many rows.
    #[test]
    fn the_error_against_mindlin_is_of_second_order_in_the_spacing() {
        let exact = contact(BALL, 100.0);
        let u = 0.7 * exact.full_slip();
        let mean_error = |count: usize| {
            let squares = (0..100).map(|i| {
                let mut row = row(BALL, 100.0, count + count * i / 200);
                row.advance(100.0, 0.0, 1);
                row.advance(100.0, u, 1);
                (row.tangential_force() - exact.loading(u)).powi(2)
            });
            (squares.sum::<f64>() / 100.0).sqrt()
        };
        let errors = [200, 800, 3200].map(mean_error);
        assert!(orders(&errors, 4.0).iter().all(|order| (1.8..2.2).contains(order)), "{errors:?}");
        assert!(errors[2] < 2e-8 * MU * 100.0, "{errors:?}");
    }

    /// Force and displacement change together, up and down. d is concave in F_N, so that one clip
    /// at the end of a line happens to leave each spring where many do; the work has no such luck.
    #[test]
    fn sub_steps_leave_the_force_and_refine_the_work_to_second_order() {
        let run = |substeps: usize| {
            let mut row = row(BALL, 100.0, 4000);
            for (force, displacement) in [
                (60.0, 0.75e-6),
                (100.0, 0.5e-6),
                (20.0, 0.4e-6),
                (90.0, -1.0e-6),
                (5.0, 0.0),
                (50.0, 0.9e-6),
                (30.0, 0.6e-6),
            ] {
                row.advance(force, displacement, substeps);
            }
            (row.tangential_force(), row.friction_work())
        };
        let fine = run(4096);
        let errors = [16, 64, 256].map(|substeps| {
            let (force, work) = run(substeps);
            assert_close(force, fine.0, 1e-12 * MU * 100.0, "T");
            (work - fine.1).abs() / fine.1
        });
        assert!(fine.0 > 1.0 && fine.0 < 0.99 * MU * 30.0, "partial slip at the end");
        assert!(orders(&errors, 4.0).iter().all(|order| (1.7..2.3).contains(order)), "{errors:?}");
        assert!(errors[2] < 1e-3, "{errors:?}");
    }

    #[test]
    fn a_rising_load_leaves_the_tangential_force() {
        let (exact, mut row) = (contact(BALL, 40.0), row(BALL, 100.0, 20_000));
        row.advance(40.0, 0.0, 1);
        row.advance(40.0, 0.6 * exact.full_slip(), 1);
        let (force, work) = (row.tangential_force(), row.friction_work());
        row.advance(100.0, row.displacement(), 50);
        assert_eq!((row.tangential_force(), row.friction_work()), (force, work));
    }

    #[test]
    fn a_falling_load_leaves_what_first_loading_would_give() {
        let mut row = row(BALL, 100.0, 20_000);
        row.advance(100.0, 0.0, 1);
        let u = 0.5 * contact(BALL, 100.0).full_slip();
        row.advance(100.0, u, 1);
        for force in [70.0, 30.0, 5.0] {
            row.advance(force, u, 20);
            assert_close(
                row.tangential_force(),
                contact(BALL, force).loading(u),
                1e-5,
                &format!("{force} N"),
            );
        }
    }

    #[test]
    fn an_oblique_rise_does_not_slip_up_to_the_slip_ratio() {
        let exact = contact(BALL, 100.0);
        let depth = exact.normal.depth();
        for (part, work) in [(0.5, false), (0.999, false), (1.5, true)] {
            let mut row = row(BALL, 100.0, 20_000);
            let ratio = part * exact.slip_ratio();
            for k in [0.2, 0.7, 1.0] {
                row.advance_at_depth(k * depth, ratio * k * depth, 10);
                let no_slip = oblique_rise(ratio, G_STAR, E_STAR, row.normal_force());
                let force = no_slip.min(MU * row.normal_force());
                assert_close(row.tangential_force(), force, 1e-9 * force, &format!("{part}, {k}"));
            }
            assert_eq!(row.friction_work() > 1e-12, work, "{part}");
        }
    }

    #[test]
    fn contact_lost_is_contact_forgotten() {
        for lift in [0.0, -10.0] {
            let mut row = row(BALL, 100.0, 2000);
            row.advance(100.0, 0.0, 1);
            row.advance(100.0, 2e-6, 10);
            assert!(row.tangential_force() > 40.0);
            row.advance(lift, 1e-6, 10);
            assert_eq!([row.tangential_force(), row.normal_force(), row.contact_radius()], [0.0; 3]);
            row.advance(100.0, row.displacement(), 10);
            assert_eq!(row.tangential_force(), 0.0, "pressed again at the same displacement");
        }
    }

    #[test]
    #[should_panic(expected = "do not decrease")]
    fn a_dented_row_is_refused() {
        PlainSpringRow::new(vec![0.0, 2.0, 1.0], 1.0, 1.0, 1.0, 1.0);
    }
}
