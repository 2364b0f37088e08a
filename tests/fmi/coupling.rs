//! Masters of a stiff system through the C interface: with rollback and derivatives from the FMU
//! they come to the same bits as with the library.
#![allow(unsafe_code, reason = "the C interface is what is tested")]

use crate::host::{Fmu, OK};
use crate::masters::{Coupled, Master, drive, mass_for, rest};
use fmi_sys::fmi2::fmi2FMUstate;
use fretting_contact::fmi2::exports::fmi2GetFMUstate;
use std::cell::Cell;

/// An instance with one saved state that is used again and again.
struct Joint {
    fmu: Fmu,
    saved: Cell<fmi2FMUstate>,
}

impl Coupled for Joint {
    type State = fmi2FMUstate;
    fn force(&self) -> f64 {
        self.fmu.real("tangential_force")
    }
    fn slope(&self) -> f64 {
        let (slope, status) =
            self.fmu.directional(&["tangential_force"], &[("tangential_displacement", 1.0)]);
        assert_eq!(status, OK);
        slope[0]
    }
    fn work(&self) -> f64 {
        self.fmu.real("dissipated_energy")
    }
    fn advance(&mut self, displacement: f64) -> bool {
        assert_eq!(self.fmu.set_real("tangential_displacement", displacement), OK);
        self.fmu.do_step(0.0, 0.0) == OK
    }
    fn save(&self) -> fmi2FMUstate {
        let mut handle = self.saved.get();
        // SAFETY: the component is alive, and the handle is null or its own.
        assert_eq!(unsafe { fmi2GetFMUstate(self.fmu.component, &raw mut handle) }, OK);
        self.saved.set(handle);
        handle
    }
    fn restore(&mut self, state: &fmi2FMUstate) {
        assert_eq!(self.fmu.restore(*state), OK);
    }
}

#[test]
fn implicit_masters_work_through_the_c_interface() {
    for (master, ratio, stiffness) in
        [(Master::SemiImplicit, 0.1, 50.0), (Master::Iterative, 0.1, 50.0), (Master::Iterative, 100.0, 2.1)]
    {
        let mass = mass_for(ratio, stiffness).expect("the contact rests");
        let joint = Joint {
            fmu: Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", 0.0), OK)),
            saved: Cell::new(core::ptr::null_mut()),
        };
        let library = drive(rest().expect("it rests"), master, ratio, mass, 1).expect("it goes on");
        assert!(library.work > 0.0 && library.calls >= 1.0);
        assert_eq!(drive(joint, master, ratio, mass, 1), Some(library), "{master:?}");
    }
}
