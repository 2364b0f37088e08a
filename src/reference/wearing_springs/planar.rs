//! The same row where the body moves in both tangential directions.

use super::{WearingRow, sum};

/// A wearing contact of a body of revolution under force control, moved in the plane: springs slip
/// back to Coulomb's circle along themselves, w grows by (k/σ₀) **τ**·Δ**s**.
#[derive(Debug, Clone)]
pub struct PlanarWearingRow {
    row: WearingRow,
    /// Displacement at which each spring is relaxed, m.
    origin: Vec<[f64; 2]>,
    displacement: [f64; 2],
}

impl PlanarWearingRow {
    /// The body of a row that has not moved yet.
    pub fn new(row: WearingRow) -> Self {
        Self { origin: vec![[0.0; 2]; row.radii.len()], displacement: [0.0; 2], row }
    }

    /// Walks a straight line to a force (N) and a place (m) in equal steps.
    pub fn walk(&mut self, force: f64, place: [f64; 2], steps: usize) {
        let (load, from) = (self.row.force, self.displacement);
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            self.displacement = [0, 1].map(|i| from[i] + share * (place[i] - from[i]));
            self.step(load + share * (force - load));
        }
    }

    fn step(&mut self, force: f64) {
        self.row.force = force;
        self.row.indentation = self.row.indentation_under(force);
        let room = self.row.room();
        let row = &mut self.row;
        let slope = row.friction * row.normal_modulus / row.tangential_modulus;
        let mut slip = [0, 1].map(|_| Vec::with_capacity(room.len()));
        let mut load = slip.clone();
        for (origin, room) in self.origin.iter_mut().zip(&room) {
            let u = [0, 1].map(|k| self.displacement[k] - origin[k]);
            let (size, bound) = (u[0].hypot(u[1]), slope * room);
            let excess = if size > bound { 1.0 - bound / size } else { 0.0 };
            for k in 0..2 {
                slip[k].push(excess * u[k]);
                load[k].push(row.tangential_modulus * (1.0 - excess) * u[k]);
                origin[k] += excess * u[k];
            }
        }
        let drops = load.map(|load| load.windows(2).map(|q| q[0] - q[1]).collect::<Vec<_>>());
        for i in 0..row.radii.len() {
            let work = |k: usize| sum(&row.pressure[i], &drops[k][i..]) * sum(&row.inverse[i], &slip[k]);
            row.depth[i] += row.wear_per_work * (work(0) + work(1)).max(0.0);
        }
        row.abel();
    }

    /// 2G* ∫ u dx, N.
    pub fn tangential_force(&self) -> [f64; 2] {
        let room = self.row.room();
        let cells = self.row.radii.windows(2).enumerate();
        let mut force = [0.0; 2];
        for (i, x) in cells {
            for (k, force) in force.iter_mut().enumerate() {
                let u = |i: usize| if room[i] > 0.0 { self.displacement[k] - self.origin[i][k] } else { 0.0 };
                *force += self.row.tangential_modulus * (x[1] - x[0]) * (u(i) + u(i + 1));
            }
        }
        force
    }

    /// The body as it has worn.
    pub fn body(&self) -> &WearingRow {
        &self.row
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a line at any angle it is the row of one dimension.
    #[test]
    fn a_line_is_that_of_one_dimension() {
        let fresh = || WearingRow::new(|x| x * x, (1.6, 80), (1.0, 1.0), (0.5, 0.02));
        let mut line = fresh();
        let mut plane = PlanarWearingRow::new(fresh());
        line.walk(4.0 / 3.0, 0.0, 1);
        plane.walk(4.0 / 3.0, [0.0; 2], 1);
        for place in [0.3, -0.3, 0.3] {
            line.walk(4.0 / 3.0, place, 10);
            plane.walk(4.0 / 3.0, [0.6 * place, -0.8 * place], 10);
        }
        let [x, y] = plane.tangential_force();
        assert!((x / 0.6 - line.tangential_force()).abs() < 1e-12 && (y / -0.8 - x / 0.6).abs() < 1e-12);
        let volume = plane.body().worn_volume() / line.worn_volume();
        // where inner springs still hold the last direction, the product is less than μ p |Δs|
        assert!((volume - 1.0).abs() < 0.02, "{volume}");
    }
}
