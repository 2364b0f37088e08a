//! Features that are not used cost nothing: the scenes of `reports/left_out.md`, asserted by
//! counted work, without a clock.

use crate::economy::{self, Measured, Reads, Scene, Work};

fn measured() -> Vec<(Scene, Measured)> {
    let scenes = economy::scenes().expect("the scenes are valid");
    let with = |scene: Scene| {
        let measured = scene.measure(0).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
        (scene, measured)
    };
    scenes.into_iter().map(with).collect()
}

#[test]
fn unused_features_cost_nothing() {
    let measured = measured();
    for (scene, measured) in &measured {
        println!("{}: {:?}", scene.name, measured.counted);
        for work in scene.leaves_out {
            assert_eq!(measured.of(*work), 0, "{}: {work:?}", scene.name);
        }
    }

    let of = |name: &str| {
        measured.iter().find(|(scene, _)| scene.name == name).map(|(_, measured)| measured).expect(name)
    };
    let count = |name: &str, work| of(name).of(work);
    let (constant, varying) = ("partial slip, fast wear", "load varies, fast wear");
    // the counters count: fast wear needs everything, and more of it where the load varies
    for work in [Work::Contacts, Work::Transforms, Work::Updates] {
        assert!(count(varying, work) > count(constant, work) && count(constant, work) > 0, "{work:?}");
    }
    // only the moving mesh of a steady motion makes matrices
    assert!(count(constant, Work::Factorisations) > 0);
    assert_eq!(count(varying, Work::Factorisations), 0);
    // at constant load 25 cycles need no more than an update at each of their 50 reversals
    assert!(count(constant, Work::Updates) <= 50);
    // one call for them needs no more than stepping through them, and walks no single step
    let one = "25 cycles in one call, fast wear";
    assert!(count(one, Work::Transforms) <= count(constant, Work::Transforms));
    assert!(count(one, Work::Walks) <= 2);
    // which quantity is held, and what the profile is given by, changes no count
    for (plain, other) in [
        ("partial slip", "partial slip, depth held"),
        ("partial slip", "partial slip, table of 1e4 points"),
        ("load varies", "depth varies"),
        ("load varies", "load varies, table of 1e4 points"),
        ("partial slip, slow wear", "partial slip"),
        ("partial slip, slow wear", "partial slip, slow wear, both bodies"),
        ("partial slip, fast wear", "partial slip, fast wear, both bodies"),
        // a coating that holds, and probes that nobody reads
        ("partial slip, slow wear", "partial slip, slow wear, coated"),
        ("partial slip, fast wear", "partial slip, fast wear, coated"),
        ("partial slip, slow wear", "partial slip, slow wear, fixed probes"),
    ] {
        assert_eq!(of(plain).counted, of(other).counted, "{plain} against {other}");
    }
    // who reads fields pays for them; the wear depth is read in memory that is there already
    for (scene, measured) in &measured {
        let requests = measured.of(Work::Requests);
        match scene.reads {
            Reads::Fields => assert!(requests > 0, "{}: {:?}", scene.name, measured.counted),
            Reads::WornDepth => assert_eq!(requests, 0, "{}: {:?}", scene.name, measured.counted),
            _ => {}
        }
    }
}
