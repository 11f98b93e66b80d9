//! Physical faults of a gel: force and picture change together.

use taceva_core::{Factory, Rig};
use taceva_sim::contact::{Indentation, Solid};
use taceva_sim::{GelFault, Model, Origin, Parameters, SensorFactory, SimulatedRig};

#[test]
fn every_fault_of_every_gel_states_its_assumptions_in_the_table() {
    for model in Model::ALL {
        let new = model.parameters();
        for fault in GelFault::ALL {
            assert_eq!(GelFault::from_name(fault.name()), Some(fault));
            for severity in [1, 3] {
                let table = Parameters::worn_table(model.table(), fault, severity);
                let table = match table {
                    Ok(table) => table,
                    // A thin gel may not be thinner and allow the same depth.
                    Err(_) if fault == GelFault::Thickness => continue,
                    Err(error) => panic!("{model} {fault:?}: {error}"),
                };
                assert!(table.contains("assumption: "), "{model} {fault:?}");
                let worn = Parameters::parse(&table).expect("it was checked");
                assert_ne!(worn.digest(), new.digest(), "{model} {fault:?}");
                let changed = worn.entries().iter().filter(|entry| {
                    let place = (entry.section, entry.key);
                    let mut before = new.entries().iter();
                    let before = before.find(|before| (before.section, before.key) == place);
                    before.is_none_or(|before| before.value.to_bits() != entry.value.to_bits())
                });
                let changed: Vec<_> = changed.collect();
                assert!(!changed.is_empty(), "{model} {fault:?}");
                assert!(changed.iter().all(|entry| entry.origin == Origin::Free));
            }
        }
    }
}

#[test]
fn a_sensor_opens_with_a_fault_and_its_provenance_shows_other_parameters() {
    let sensors = SensorFactory::new(Model::GelSight).expect("a driver");
    let parameters = |arguments: &str| {
        let mut rig = Rig::new();
        let args = sensors.descriptor().args(arguments);
        let args = args.expect("arguments");
        let _sensor = sensors.open(&args, &mut rig).expect("opens");
        let bench = SimulatedRig::of(&mut rig, "bench");
        bench.provenance().expect("a bench").parameters
    };
    let [new, worn] = ["", "fault=gel_softening;severity=3"].map(parameters);
    assert_ne!(new, worn);
    assert_eq!(new, *Model::GelSight.parameters().digest());
    let refused = sensors.descriptor().args("fault=gel_softning");
    assert!(refused.is_err());
}

/// Normal force of `parameters` at half the greatest depth.
fn force_n(parameters: &Parameters) -> f64 {
    let depth_mm = 0.5 * parameters.probing.depth_max_mm;
    let contact = Solid::new(parameters).contact(&Indentation {
        place_mm: [0.0; 2],
        depth_mm,
        deepest_mm: depth_mm,
        shear_mm: [0.0; 2],
        indenter_radius_mm: 2.0,
        stiffness: 1.0,
    });
    contact.force_n[2]
}

#[test]
fn a_gel_ages_with_the_load_of_its_presses_if_its_table_states_rates() {
    for model in Model::ALL {
        let table = Parameters::ageing_table(model.table()).expect("a table");
        let new = Parameters::parse(&table).expect("it has rates");
        let ageing = new.entries().iter().filter(|of| of.section == "ageing");
        assert!(ageing.clone().count() == 2 && ageing.clone().all(|of| of.origin == Origin::Free));
        let ages = [0.0, 1.0, 10.0].map(|load_kn| new.clone().aged(load_kn));
        let forces = ages.each_ref().map(force_n);
        assert!(forces[0] > forces[1] && forces[1] > forces[2], "{model}");
        let loss = (-0.02_f64 * 10.0).exp();
        assert!(
            (forces[2] / forces[0] - loss).abs() < 1e-6,
            "{model}: {forces:?}"
        );
        let gloss = ages
            .each_ref()
            .map(|of| of.wear.map_or(0.0, |wear| wear.gloss));
        assert!(
            gloss[0] == 0.0 && gloss[1] > 0.0 && gloss[2] > gloss[1],
            "{model}"
        );
        assert_eq!(ages[0], new, "{model}: without a load");
        let usual = model.parameters();
        assert_eq!(usual.clone().aged(10.0), usual, "{model}: without rates");
        // A table of one's own keeps its rates.
        assert_eq!(Parameters::ageing_table(&table), Ok(table), "{model}");
    }
}

#[test]
fn a_sensor_ages_only_on_request_and_remains_the_same_gel() {
    let sensors = SensorFactory::new(Model::GelSight).expect("a driver");
    let parameters = |arguments: &str| {
        let mut rig = Rig::new();
        let args = sensors.descriptor().args(arguments).expect("arguments");
        let _sensor = sensors.open(&args, &mut rig).expect("opens");
        let bench = SimulatedRig::of(&mut rig, "bench");
        bench.provenance().expect("a bench").parameters
    };
    let [plain, loaded, new, old] =
        ["", "load_kn=50", "ages=true", "ages=true;load_kn=50"].map(parameters);
    assert_eq!(plain, loaded, "the load of a gel that does not age");
    assert_eq!(new, old, "one gel at two ages");
    assert_ne!(plain, new);
}
