//! A row of springs that are stiffer along y than along x, moved in small steps: a brute-force
//! check for an elliptic contact that moves in the plane.
//!
//! Each spring carries (G_x u_x, G_y u_y) per length, at most μE*(d − g), and slips along that
//! force. A step moves all springs and lets each slip back to its bound at the new force (closest
//! point); the error is of first order in the step and of second order in the spacing. No wear.

/// Springs at x = (i + ½)Δx on one half of a row under a parabola g = x²/R.
#[derive(Debug, Clone)]
pub struct AnisotropicRow {
    radius: f64,
    spacing: f64,
    normal_modulus: f64,
    moduli: [f64; 2],
    friction: f64,
    depth: f64,
    place: [f64; 2],
    deflection: Vec<[f64; 2]>,
    work: f64,
}

impl AnisotropicRow {
    /// `count` springs over 0 < x < `length` (m), in contact at depth 0; `radius` R in m, moduli E*
    /// and (G_x, G_y) in Pa.
    pub fn new(
        radius: f64,
        (length, count): (f64, usize),
        normal_modulus: f64,
        moduli: [f64; 2],
        friction: f64,
    ) -> Self {
        let spacing = length / count as f64;
        let deflection = vec![[0.0; 2]; count];
        Self {
            radius,
            spacing,
            normal_modulus,
            moduli,
            friction,
            depth: 0.0,
            place: [0.0; 2],
            deflection,
            work: 0.0,
        }
    }

    /// Walks the straight line to a depth (m) and a place (m) in equal steps.
    pub fn walk(&mut self, depth: f64, place: [f64; 2], steps: usize) {
        let (from_depth, from) = (self.depth, self.place);
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            let next = [0, 1].map(|i| from[i] + share * (place[i] - from[i]));
            self.step(from_depth + share * (depth - from_depth), next);
        }
    }

    fn step(&mut self, depth: f64, place: [f64; 2]) {
        for (i, u) in self.deflection.iter_mut().enumerate() {
            let x = (i as f64 + 0.5) * self.spacing;
            let bound = self.friction * self.normal_modulus * (depth - x * x / self.radius);
            if bound <= 0.0 {
                *u = [0.0; 2];
                continue;
            }
            let force = [0, 1].map(|k| self.moduli[k] * (u[k] + place[k] - self.place[k]));
            let slip = slip_to(force, self.moduli, bound);
            let after = [0, 1].map(|k| force[k] / (1.0 + self.moduli[k] * slip / bound));
            *u = [0, 1].map(|k| after[k] / self.moduli[k]);
            self.work += 2.0 * self.spacing * bound * slip;
        }
        (self.depth, self.place) = (depth, place);
    }

    /// 2 ∫ G u dx along both axes, N.
    pub fn tangential_force(&self) -> [f64; 2] {
        [0, 1].map(|k| {
            let sum: f64 = self.deflection.iter().map(|u| u[k]).sum();
            2.0 * self.moduli[k] * self.spacing * sum
        })
    }

    /// Work of friction so far, J.
    pub fn work(&self) -> f64 {
        self.work
    }
}

/// Length s of the slip along the force, m, after which it is at the bound: |force/(1 + G s/bound)|
/// falls with s and is convex, so that Newton's method approaches the root from below.
fn slip_to(force: [f64; 2], moduli: [f64; 2], bound: f64) -> f64 {
    let mut slip = 0.0;
    for _ in 0..100 {
        let shares = [0, 1].map(|k| 1.0 + moduli[k] * slip / bound);
        let [x, y] = [0, 1].map(|k| force[k] / shares[k]);
        let size = x.hypot(y);
        if size <= bound * (1.0 + 4.0 * f64::EPSILON) {
            break;
        }
        let fall = (moduli[0] * x * x / shares[0] + moduli[1] * y * y / shares[1]) / (bound * size);
        slip += (size - bound) / fall;
    }
    slip
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::MonomialContact;

    const MODULI: [f64; 2] = [0.8, 1.1];

    fn row(springs: usize) -> AnisotropicRow {
        let mut row = AnisotropicRow::new(1.0, (1.2, springs), 1.0, MODULI, 0.5);
        row.walk(1.0, [0.0; 2], 1);
        row
    }

    /// Along either axis it is the contact of a sphere with the modulus of that axis.
    #[test]
    fn along_an_axis_it_is_the_closed_form() {
        for axis in 0..2 {
            let full_slip = 0.5 / MODULI[axis];
            let law = MonomialContact { exponent: 1.5, friction_limit: 0.5 * 4.0 / 3.0, full_slip };
            let mut row = row(4000);
            let mut place = [0.0; 2];
            place[axis] = 0.7 * full_slip;
            row.walk(1.0, place, 20);
            assert!((row.tangential_force()[axis] / law.loading(place[axis]) - 1.0).abs() < 1e-5);
            assert!((4.0 * row.work() / law.loop_work(place[axis]) - 1.0).abs() < 1e-3);
        }
    }

    /// On an oblique way that turns the error is of first order in the step.
    #[test]
    fn the_error_is_of_first_order_in_the_step() {
        let force = |steps: usize| {
            let mut row = row(200);
            row.walk(1.0, [0.6, 0.2], steps);
            row.walk(1.1, [0.1, 0.7], steps);
            row.tangential_force()
        };
        let found = [50, 100, 200].map(force);
        let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let order = (distance(found[0], found[1]) / distance(found[1], found[2])).log2();
        assert!((order - 1.0).abs() < 0.15, "{order}");
    }
}
