//! Faults of a gel by physics: force and picture change together.

use taceva_core::{Factory, Rig};
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
