//! Cyclic loading: many displacement cycles at constant load in a few steps.
//!
//! Under constant load a steady cycle of amplitude U₀ wears ∂w/∂N = 4 κ p(r) s(r) with κ = kμ/σ₀ and s the descent of
//! U₀ − min(U₀, b(x)) (exact for a frozen profile). The equation is stiff and linear in the wear through p: each step is
//! linearly implicit of first order, done once whole and once in two halves; their difference controls the step and is
//! removed by extrapolation, which makes the result second-order.

use super::FrettingContact;
use super::history::add_depth;
use crate::error::Error;
use crate::friction::{Path, Springs};
use crate::surface::{Contact, Nodes};
use crate::wear::{Edge, Pending, pressure_nodes, worn_depth};

/// Most internal steps of one call: a whole life takes some hundred.
const MOST_STEPS: u32 = 1000;

/// Wear per cycle at one state of the profile.
struct Rate {
    contact: Contact,
    /// Work per area (J/m²) and slip path (m) of one cycle at the nodes, and its work (J).
    cycle: Pending,
    springs: Springs,
}

/// One trial step: the worn depth it brings at the nodes (m) and its work (J).
struct Trial {
    depth: Vec<f64>,
    work: f64,
}

impl FrettingContact {
    /// Runs `cycles` (≥ 0, need not be whole) displacement cycles between ±`amplitude` (m) at a constant force (N) or
    /// indentation depth (m). Afterwards the body stands at +amplitude, and [`Self::tangential_force`] is the
    /// amplitude of T.
    ///
    /// # Errors
    /// As [`Self::advance_to`]; [`Error::Input`] also for a negative amplitude or number of cycles;
    /// [`Error::TooMuchWear`] where one call asks for more wear than can be followed.
    pub fn advance_cycles(&mut self, normal: f64, amplitude: f64, cycles: f64) -> Result<(), Error> {
        let (value, _) = self.checked(normal, 0.0)?;
        for (name, number) in [("displacement_amplitude", amplitude), ("cycles", cycles)] {
            if !(number.is_finite() && number >= 0.0) {
                let requirement = "it has to be finite and not negative";
                return Err(Error::Input { name, value: number, requirement });
            }
        }
        self.view.take();
        self.transaction(|this| this.run_cycles(value, amplitude, cycles))?;
        self.counters.steps += 1;
        Ok(())
    }

    fn run_cycles(&mut self, value: f64, amplitude: f64, cycles: f64) -> Result<(), Error> {
        self.settle()?;
        self.contact = self.contact_at(value)?;
        self.reach = self.reach.max(self.contact.radius);
        if self.wear.is_none() {
            let contact = self.contact;
            let (springs, work) = self.quarter(&contact, amplitude);
            self.work += 4.0 * cycles * work;
            self.springs = springs;
        } else {
            self.wear_cycles(value, amplitude, cycles)?;
        }
        let Contact { depth, radius, .. } = self.contact;
        if !(self.work.is_finite()
            && depth.is_finite()
            && radius.is_finite()
            && self.normal_reaction().is_finite())
        {
            let normal = if self.constants.force_control { value * self.force_scale() } else { value };
            return Err(Error::NotFinite {
                what: "the state of the contact",
                normal,
                displacement: amplitude,
            });
        }
        self.displacement = amplitude;
        self.direction = 1.0;
        if let Some(wear) = &mut self.wear {
            wear.segment.unslipped = self.springs.clone();
            wear.segment.contact = (!self.contact.is_open()).then_some(self.contact);
            wear.segment.work = 0.0;
        }
        Ok(())
    }

    /// The first quarter of a cycle from rest: springs at +amplitude and the work (J), a fourth of a steady cycle's.
    fn quarter(&mut self, contact: &Contact, amplitude: f64) -> (Springs, f64) {
        let path = Path {
            surface: &self.surface,
            control: self.parameters.normal_control,
            bound_slope: self.constants.bound_slope(),
            from: Contact { control: self.touch_control(), radius: 0.0, ..*contact },
            to: *contact,
            start: 0.0,
            end: 0.0,
            sampling: 1.0 / self.parameters.resolution as f64,
        };
        let (rest, _) = Springs::default().walk(&path, Springs::default());
        let (springs, half_work) =
            rest.walk(&Path { from: *contact, end: amplitude, ..path }, Springs::default());
        self.counters.spring_walks += 2;
        (springs, 2.0 * self.constants.tangential_modulus * half_work)
    }

    fn wear_cycles(&mut self, value: f64, amplitude: f64, cycles: f64) -> Result<(), Error> {
        let mut left = cycles;
        let mut rate = self.rate(value, amplitude)?;
        let mut step = left;
        let mut steps = 0;
        while left > 0.0 && rate.cycle.work > 0.0 {
            if steps == MOST_STEPS {
                return Err(Error::TooMuchWear { cycles, left, amplitude, steps });
            }
            steps += 1;
            self.adapt_nodes(&rate, amplitude);
            rate = self.rate(value, amplitude)?;
            step = step.min(left).min(self.first_step(&rate, amplitude));
            let whole = self.trial(&rate, step)?;
            let half = self.trial(&rate, 0.5 * step)?;
            let start = self.surface.clone();
            self.take(&half.depth);
            let middle = self.rate(value, amplitude)?;
            let second = self.trial(&middle, 0.5 * step)?;
            let halves: Vec<f64> = half.depth.iter().zip(&second.depth).map(|(a, b)| a + b).collect();
            // a trial that is far too long may all but open the contact: what it did is seen in the larger one
            let reach = rate.contact.radius.max(middle.contact.radius);
            let error = self.image_difference(&whole.depth, &halves, reach) / rate.contact.depth;
            let allowed = self.parameters.tolerance;
            let factor = (0.8 * (allowed / error.max(1e-300)).sqrt()).clamp(0.2, 3.0);
            self.surface = start;
            if error > allowed && step > 1e-12 * cycles {
                self.counters.rejected_steps += 1;
                step *= factor.min(0.8);
                continue;
            }
            let depth: Vec<f64> =
                halves.iter().zip(&whole.depth).map(|(h, w)| (2.0 * h - w).max(0.0)).collect();
            // the same extrapolation for the work, W' = W(h): twice the two halves less the whole
            let work = 2.0 * (half.work + second.work) - whole.work;
            self.work += work;
            self.take(&self.scaled_to(depth, work));
            self.counters.profile_updates += 1;
            left -= step;
            step *= factor;
            rate = self.rate(value, amplitude)?;
        }
        self.contact = rate.contact;
        self.springs = rate.springs;
        self.reach = self.reach.max(self.contact.radius);
        Ok(())
    }

    /// A first guess at a step: what would wear a tenth of the indentation depth off the slipping annulus.
    fn first_step(&self, rate: &Rate, amplitude: f64) -> f64 {
        let bound_slope = self.constants.bound_slope();
        let stick = rate.springs.stick_radius(&rate.contact, bound_slope, amplitude);
        let annulus = (rate.contact.radius - stick) * (rate.contact.radius + stick);
        let volume = 0.1 * std::f64::consts::PI * annulus * rate.contact.depth.abs();
        let per_cycle = self.constants.wear_per_work * rate.cycle.work;
        if volume > 0.0 { volume / per_cycle } else { f64::INFINITY }
    }

    /// Nodes for the present contact and front.
    fn adapt_nodes(&mut self, rate: &Rate, amplitude: f64) {
        let front = rate.springs.stick_radius(&rate.contact, self.constants.bound_slope(), amplitude);
        let profile = self.surface.profile();
        let nodes = match self.surface.worn() {
            None => {
                Nodes::around(profile, self.parameters.resolution, rate.contact.radius.max(self.reach), front)
            }
            Some(nodes) => {
                let mut nodes = nodes.clone();
                nodes.adapt(profile, rate.contact.radius, front);
                nodes
            }
        };
        if let (Some(wear), Some(before)) = (&mut self.wear, self.surface.worn()) {
            wear.pending.moved_to(before.x(), nodes.x());
        }
        self.surface.set_worn(Some(nodes));
    }

    /// What one cycle does on the present surface.
    fn rate(&mut self, value: f64, amplitude: f64) -> Result<Rate, Error> {
        let contact = self.contact_at(value)?;
        self.contact = contact;
        if contact.is_open() {
            let springs = Springs::default();
            return Ok(Rate { contact, cycle: Pending::default(), springs });
        }
        let (springs, quarter_work) = self.quarter(&contact, amplitude);
        if !quarter_work.is_finite() {
            let normal = if self.constants.force_control { value * self.force_scale() } else { value };
            return Err(Error::NotFinite { what: "the work of a cycle", normal, displacement: amplitude });
        }
        let mut cycle = Pending { work: 4.0 * quarter_work, ..Default::default() };
        if let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn())
            && cycle.work > 0.0
        {
            let (tables, made) = wear.tables.get(nodes);
            let edge = Edge::new(nodes, &contact, self.surface.profile().outer_radius());
            let room: Vec<f64> =
                nodes.x().iter().map(|&x| (contact.depth - self.surface.image(x)).max(0.0)).collect();
            // a front that stands on a node is a tie to rounding, and a slip of rounding would grow there
            let least = 1e-9 * amplitude;
            let slip: Vec<f64> = room
                .iter()
                .map(|room| amplitude - self.constants.bound_slope() * room)
                .map(|slip| if slip > least { slip } else { 0.0 })
                .collect();
            let load: Vec<f64> = room.iter().map(|room| self.constants.normal_modulus * room).collect();
            let pressure = pressure_nodes(&tables, nodes.x(), &load, &edge);
            let path: Vec<f64> = tables.descend(&slip, slip.len()).iter().map(|s| 4.0 * s.max(0.0)).collect();
            let friction = self.constants.friction_coefficient;
            let traction: Vec<f64> = pressure.iter().map(|p| friction * p).collect();
            let work = std::mem::take(&mut cycle.work);
            cycle.add((nodes, &tables), &contact, (&traction, &path), work, f64::MAX, &self.constants);
            self.counters.transform_tables += u64::from(made);
            self.counters.pressure_transforms += 1;
            self.counters.descent_transforms += 1;
        }
        Ok(Rate { contact, cycle, springs })
    }

    /// Linearly implicit step over a number of cycles.
    fn trial(&mut self, rate: &Rate, cycles: f64) -> Result<Trial, Error> {
        let pending = rate.cycle.scaled(cycles);
        let Some(wear) = &mut self.wear else { return Ok(Trial { depth: Vec::new(), work: 0.0 }) };
        let Some(nodes) = self.surface.worn() else { return Ok(Trial { depth: Vec::new(), work: 0.0 }) };
        let (tables, _) = wear.tables.get(nodes);
        let update = worn_depth(
            &self.surface,
            &tables,
            &pending,
            self.parameters.normal_control,
            &self.constants,
            self.parameters.tolerance,
        )?;
        self.counters.factorisations += update.factorisations;
        Ok(Trial { depth: update.depth, work: pending.work })
    }

    /// Takes a worn depth at the nodes off the surface.
    fn take(&mut self, depth: &[f64]) {
        let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return };
        let (tables, _) = wear.tables.get(nodes);
        let mut nodes = nodes.clone();
        let image = add_depth(&nodes, &tables, depth);
        nodes.set_worn_image(image, self.surface.profile());
        self.surface.set_worn(Some(nodes));
        self.counters.descent_transforms += 1;
    }

    /// A worn depth scaled to the volume that belongs to `work`: its integral over the nodes is less exact than the
    /// springs' work, mostly at the contact edge, where the pressure ends like a square root.
    fn scaled_to(&self, mut depth: Vec<f64>, work: f64) -> Vec<f64> {
        let volume = self.surface.worn().map_or(0.0, |nodes| nodes.volume(&depth));
        if volume > 0.0 {
            let scale = self.constants.wear_per_work * work / volume;
            depth.iter_mut().for_each(|w| *w *= scale);
        }
        depth
    }

    /// Largest difference of the images of two worn depths inside a radius, m.
    fn image_difference(&mut self, a: &[f64], b: &[f64], reach: f64) -> f64 {
        let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return 0.0 };
        let (tables, _) = wear.tables.get(nodes);
        let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
        let inside = nodes.x().partition_point(|&x| x < reach);
        tables.ascend(&difference).iter().take(inside).fold(0.0, |most: f64, d| most.max(d.abs()))
    }
}
