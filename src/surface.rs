//! The worn profile: the analytic unworn one plus the image of the wear on a set of nodes.
//!
//! The 1-D image is g = g₀ + h. g₀ is the unworn profile's closed form; h, the image of the worn
//! depth w, is piecewise linear in X = x² between the nodes, so w, the inverse Abel transform of h,
//! has the square-root cusps of worn profiles built in and g can take the steep fronts that wear
//! leaves. Without wear there are no nodes at all.

mod depth_volume;
mod node_transforms;
mod nodes;
mod region;
mod slopes;

pub(crate) use node_transforms::{NodeTransforms, TransformCache};
pub(crate) use nodes::{FrontMotion, MeshPlace, Nodes, kept_nodes, outer_weight};
pub(crate) use region::Region;
pub(crate) use slopes::Slopes;

use crate::error::Error;
use crate::parameters::NormalControl;
use crate::profile::{Profile, ProfileTable};
use crate::range;
use crate::roots;
use std::mem::{swap, take};
use std::sync::Arc;

/// Relative size of what is rounding: the difference of two places that are one, and a slip of
/// none.
pub(crate) const ROUNDING: f64 = 1e-11;

/// Image values at one radius.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Place {
    /// Radius x, m.
    pub(crate) x: f64,
    /// Image g(x), m.
    pub(crate) image: f64,
    /// Load integral φ(x) = ∫₀ˣ ξ g' dξ, m².
    pub(crate) load: f64,
    /// Square integral Q(x) = ∫₀ˣ g² dξ, m³.
    pub(crate) square: f64,
}

/// Shape of the moving body as it is now.
#[derive(Debug, Clone)]
pub(crate) struct Surface {
    profile: Arc<Profile>,
    worn: Option<Arc<Nodes>>,
}

/// The normal contact at one load.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Contact {
    /// Controlled quantity: load F_N/(2E*) in m² or indentation depth in m.
    pub(crate) control: f64,
    /// Indentation depth d, m; where the bodies are apart, that of first touch.
    pub(crate) depth: f64,
    /// Contact radius a, m; 0 where the bodies are apart.
    pub(crate) radius: f64,
    /// Load F_N/(2E*), m²; 0 where the bodies are apart.
    pub(crate) load: f64,
}

impl Contact {
    pub(crate) fn is_open(&self) -> bool {
        self.radius == 0.0
    }

    /// The quantity that is controlled, m² of load or m.
    pub(crate) fn value_of(&self, control: NormalControl) -> f64 {
        match control {
            NormalControl::Force => self.load,
            NormalControl::Indentation => self.depth,
        }
    }
}

impl Surface {
    pub(crate) fn new(profile: Profile) -> Self {
        Self::shared(Arc::new(profile))
    }

    /// A body whose unworn profile others have, too.
    pub(crate) fn shared(profile: Arc<Profile>) -> Self {
        Self { profile, worn: None }
    }

    pub(crate) fn profile(&self) -> &Profile {
        &self.profile
    }

    pub(crate) fn worn(&self) -> Option<&Nodes> {
        self.worn.as_deref()
    }

    /// The surface with a change of depth and image (m) at its nodes on top, times a factor.
    pub(crate) fn worn_further(&self, (depth, image): (&[f64], &[f64]), factor: f64) -> Self {
        let worn = self.worn().map(|nodes| {
            let sum = |old: &[f64], change: &[f64]| {
                old.iter().zip(change).map(|(old, change)| old + factor * change).collect()
            };
            let mut worn = nodes.clone();
            worn.set_worn(sum(nodes.worn_image(), image), sum(nodes.depth(), depth), &self.profile);
            Arc::new(worn)
        });
        Self { profile: self.profile.clone(), worn }
    }

    /// Appends nodes far beyond the wear.
    pub(crate) fn extend_far(&mut self) {
        if let Some(nodes) = &mut self.worn {
            Arc::make_mut(nodes).extend_far(&self.profile);
        }
    }

    /// Whether another surface of this profile has worn as this one has.
    pub(crate) fn is_worn_as(&self, other: &Self) -> bool {
        match (&self.worn, &other.worn) {
            (Some(own), Some(others)) => Arc::ptr_eq(own, others) || own == others,
            (own, others) => own.is_none() && others.is_none(),
        }
    }

    /// Gives its nodes for others, which no other surface shares.
    pub(crate) fn swap_worn(&mut self, nodes: &mut Nodes) {
        match self.worn.as_mut().and_then(Arc::get_mut) {
            Some(worn) => swap(worn, nodes),
            None => self.worn = Some(Arc::new(take(nodes))),
        }
    }

    pub(crate) fn set_worn(&mut self, nodes: Option<Nodes>) {
        self.worn = nodes.map(Arc::new);
    }

    /// All image values at radius x.
    #[inline(always)]
    pub(crate) fn place(&self, x: f64) -> Place {
        let Some(nodes) = &self.worn else {
            let (image, load, square) = self.profile.image_and_integrals(x);
            return Place { x, image, load, square };
        };
        nodes.place_in(&self.profile, nodes.cell(x), x)
    }

    /// Image g(x), m.
    pub(crate) fn image(&self, x: f64) -> f64 {
        match &self.worn {
            Some(nodes) => nodes.image_at(&self.profile, x),
            None => self.profile.image(x),
        }
    }

    /// Images at several radii, m.
    pub(crate) fn images(&self, radii: &[f64]) -> Vec<f64> {
        match &self.worn {
            Some(nodes) => radii.iter().map(|x| nodes.image_at(&self.profile, *x)).collect(),
            None => self.profile.images(radii),
        }
    }

    /// Image at the axis, m.
    pub(crate) fn tip(&self) -> f64 {
        // the first node lies there
        self.profile.image(0.0) + self.worn.as_ref().map_or(0.0, |nodes| nodes.worn_image()[0])
    }

    /// What wear has changed in the image at x, m.
    pub(crate) fn worn_image(&self, x: f64) -> f64 {
        self.worn.as_ref().map_or(0.0, |nodes| nodes.worn_image_at(&self.profile, x))
    }

    /// Slope g'(x) of the image.
    pub(crate) fn image_slope(&self, x: f64) -> f64 {
        match &self.worn {
            Some(nodes) => nodes.slope_at(&self.profile, x),
            None => self.profile.image_slope(x),
        }
    }

    /// The same body without its wear.
    pub(crate) fn unworn(&self) -> Self {
        Self { profile: self.profile.clone(), worn: None }
    }

    /// Image g(x), m, and load integral φ(x), m².
    fn image_and_load(&self, x: f64) -> (f64, f64) {
        match &self.worn {
            Some(nodes) => nodes.image_and_load_in(&self.profile, nodes.cell(x), x),
            None => (self.profile.image(x), self.profile.load_integral(x)),
        }
    }

    /// Load integral φ(x), m².
    pub(crate) fn load(&self, x: f64) -> f64 {
        self.image_and_load(x).1
    }

    /// Radius in [low, high] where the image takes the value `image`; the image rises there.
    #[inline(always)]
    pub(crate) fn radius_of_image(&self, image: f64, low: f64, high: f64) -> f64 {
        if self.worn.is_none()
            && let Some(x) = self.profile.radius_at_depth(image)
        {
            // `f64::clamp` is a call, since it checks the bounds
            return if x < low {
                low
            } else if x > high {
                high
            } else {
                x
            };
        }
        match self.worn().and_then(|nodes| nodes.radius_of_image(&self.profile, image, (low, high))) {
            Some((x, _)) => x,
            None => roots::of_rising(low, high, |x| (self.image(x) - image, self.image_slope(x))),
        }
    }

    /// Place in [low, high] where the image takes the value `image`; it rises there.
    #[inline(always)]
    pub(crate) fn place_of_image(&self, image: f64, low: f64, high: f64) -> Place {
        if let Some(nodes) = self.worn()
            && let Some((x, cell)) = nodes.radius_of_image(&self.profile, image, (low, high))
        {
            return nodes.place_in(&self.profile, Some(cell), x);
        }
        self.place(self.radius_of_image(image, low, high))
    }

    /// The contact under a given load F_N/(2E*), m², or indentation depth, m.
    ///
    /// # Errors
    /// [`Error::BeyondTable`], [`Error::NonMonotoneImage`] where the profile cannot carry it;
    /// [`Error::BeyondNumbers`]. `force_scale` = 2E* turns loads into forces.
    pub(crate) fn contact(
        &self,
        control: NormalControl,
        value: f64,
        force_scale: f64,
    ) -> Result<Contact, Error> {
        // under a force that of a disc is found on the lines between its nodes: with another edge
        // than theirs the springs next to it would not be at their bound
        if let Some(place) = self.worn().and_then(Nodes::mesh)
            && place.contact.value_of(control) == value
            && (place.region, control) != (Region::Disc, NormalControl::Force)
        {
            let Contact { depth, radius, load, .. } = place.contact;
            self.check_one_disc(radius)?;
            let load = if place.region == Region::Disc { self.load_at_edge(radius, depth) } else { load };
            // as below, a NaN has to stay one
            let load = if load < 0.0 { 0.0 } else { load };
            range::contact(radius, depth, load, load * force_scale)?;
            return Ok(Contact { control: value, depth, radius, load });
        }
        let touch = self.tip();
        let apart = if control == NormalControl::Force { touch } else { value };
        let open = Contact { control: value, depth: apart, radius: 0.0, load: 0.0 };
        let contact = match control {
            NormalControl::Force if value > 0.0 => {
                let radius = self.radius_at_load(value, force_scale)?;
                Contact { control: value, depth: self.depth_at_edge(radius, value), radius, load: value }
            }
            NormalControl::Indentation if value > touch => {
                let radius = self.radius_at_depth(value)?;
                let load = self.load_at_edge(radius, value);
                // a body worn free by wear at this depth touches in places at most; a NaN has to
                // stay one, to be refused
                if load <= 0.0 { open } else { Contact { control: value, depth: value, radius, load } }
            }
            _ => open,
        };
        self.check_one_disc(contact.radius)?;
        if contact.radius < range::LEAST_RADIUS {
            return Ok(open);
        }
        let Contact { depth, radius, load, .. } = contact;
        range::contact(radius, depth, load, load * force_scale)?;
        Ok(contact)
    }

    /// Depth (m) at which a contact of some radius (m) carries a load, m²:
    /// F_N/(2E*) = φ(a) + a (d − g(a)). The difference is what a body that ends at a carries beyond
    /// its image; elsewhere it makes good the rounding of a, which next to the rim of a flat would
    /// lose all digits of g.
    fn depth_at_edge(&self, radius: f64, load: f64) -> f64 {
        self.image(radius) + (load - self.load(radius)) / radius
    }

    /// The load (m²) of a contact of some radius at a depth, m.
    fn load_at_edge(&self, radius: f64, depth: f64) -> f64 {
        let (image, load) = self.image_and_load(radius);
        load + radius * (depth - image)
    }

    /// Load (m²) and contact radius (m) of a worn body at a depth, m, where a cell between its
    /// nodes holds the edge: what [`Self::contact`] gives but for rounding, for a search. `None`
    /// where only that knows.
    pub(crate) fn load_in_cell(&self, depth: f64) -> Option<(f64, f64)> {
        let nodes = self.worn().filter(|nodes| nodes.mesh().is_none())?;
        if matches!(&*self.profile, Profile::Table(_)) || depth <= self.tip() {
            return None;
        }
        let (radius, cell) = nodes.outermost_radius_of_image(&self.profile, depth)?;
        let (image, load) = nodes.image_and_load_in(&self.profile, Some(cell), radius);
        let load = load + radius * (depth - image);
        (load > 0.0 && radius >= range::LEAST_RADIUS).then_some((load, radius))
    }

    /// Whether a contact reaches to where the unworn image falls.
    pub(crate) fn reaches_falling_image(&self, contact_radius: f64) -> bool {
        matches!(&*self.profile, Profile::Table(table) if contact_radius > table.monotone_up_to())
    }

    /// Refuses a contact that would not be one disc.
    pub(crate) fn check_one_disc(&self, contact_radius: f64) -> Result<(), Error> {
        if let Profile::Table(table) = &*self.profile
            && self.reaches_falling_image(contact_radius)
            && self.falls_behind(table, contact_radius)
        {
            return Err(Error::NonMonotoneImage {
                radius: table.monotone_up_to(),
                contact_radius,
                fall: table.largest_fall(),
                roughness: table.roughness(),
            });
        }
        Ok(())
    }

    /// Whether the present image still falls right behind the radius at which the unworn one does:
    /// up to the next point of the table, since waves may be as short as a few.
    fn falls_behind(&self, table: &ProfileTable, contact_radius: f64) -> bool {
        let radius = table.monotone_up_to();
        let next = table.radii().partition_point(|r| *r <= radius);
        let next = table.radii().get(next).map_or(contact_radius, |next| next.min(contact_radius));
        self.image(next) < self.image(radius)
    }

    /// Outermost radius at which the load integral is `load`.
    fn radius_at_load(&self, load: f64, force_scale: f64) -> Result<f64, Error> {
        if self.worn.is_none()
            && let Some(x) = self.profile.radius_at_load(load)
        {
            return Ok(x);
        }
        let outer = self.profile.outer_radius();
        if outer.is_finite() && load >= self.load(outer) {
            return self.outer_edge(outer, "normal_force", load * force_scale);
        }
        if let Some(x) = self.worn().and_then(|nodes| nodes.radius_at_load(&self.profile, load)) {
            return Ok(x);
        }
        let (low, high) = self.bracket(outer, |x| self.load(x), load);
        Ok(roots::of_rising(low, high, |x| (self.load(x) - load, x * self.image_slope(x))))
    }

    /// Outermost radius at which the image is `depth`.
    fn radius_at_depth(&self, depth: f64) -> Result<f64, Error> {
        if self.worn.is_none()
            && let Some(x) = self.profile.radius_at_depth(depth)
        {
            return Ok(x);
        }
        let outer = self.profile.outer_radius();
        if outer.is_finite() && depth >= self.image(outer) {
            return self.outer_edge(outer, "indentation", depth);
        }
        if let Some((x, _)) =
            self.worn().and_then(|nodes| nodes.outermost_radius_of_image(&self.profile, depth))
        {
            return Ok(x);
        }
        let (low, high) = self.bracket(outer, |x| self.image(x), depth);
        Ok(roots::of_rising(low, high, |x| (self.image(x) - depth, self.image_slope(x))))
    }

    /// The contact has reached the end of the body: an edge for the punch, an error for a table.
    fn outer_edge(&self, outer: f64, quantity: &'static str, value: f64) -> Result<f64, Error> {
        match *self.profile {
            Profile::Table(_) => Err(Error::BeyondTable { quantity, value, radius: outer }),
            _ => Ok(outer),
        }
    }

    /// Interval that holds the outermost crossing of `f` with `value`, where f ≤ value at its lower
    /// end.
    fn bracket(&self, outer: f64, f: impl Fn(f64) -> f64, value: f64) -> (f64, f64) {
        let knots: &[f64] = match (&self.worn, &*self.profile) {
            (Some(nodes), _) => nodes.x(),
            (None, Profile::Table(table)) => table.radii(),
            (None, _) => &[],
        };
        let knots = &knots[..knots.partition_point(|&knot| knot <= outer)];
        let mut low = 0.0;
        let mut high = f64::NAN;
        // from outside inward: the first knot below the value starts the interval
        for &knot in knots.iter().rev() {
            if f(knot) <= value {
                low = knot;
                break;
            }
            high = knot;
        }
        if high.is_nan() {
            // beyond all knots the unworn profile rises without end: double until it is above
            high = (low * 1.01).max(f64::MIN_POSITIVE);
            while f(high) < value && high < outer && high < 1e300 {
                low = high;
                high *= 2.0;
            }
            high = high.min(outer);
        }
        (low, high)
    }
}

#[cfg(test)]
mod tests;
