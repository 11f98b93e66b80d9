use super::*;

#[test]
fn channels_are_known_by_the_words_of_a_name_and_ranked() {
    for (name, expected) in [
        ("Fx", Some(("Fx", Reason::Name))),
        ("fz", Some(("Fz", Reason::Name))),
        ("Fz_mN", Some(("Fz", Reason::NameWithUnit))),
        ("Fz (mN)", Some(("Fz", Reason::NameWithUnit))),
        ("force_y", Some(("Fy", Reason::Words))),
        ("ForceX", Some(("Fx", Reason::Words))),
        ("Force X (N)", Some(("Fx", Reason::Words))),
        ("fz_meas", Some(("Fz", Reason::Words))),
        ("fz_raw", Some(("Fz", Reason::MoreWords))),
        ("left_force_z", Some(("Fz", Reason::MoreWords))),
        ("force2_z", Some(("Fz", Reason::MoreWords))),
        ("ft.wrench.torque.z", Some(("Tz", Reason::Parent))),
        ("wrench.force.x", Some(("Fx", Reason::Parent))),
        ("/ft/force/z", Some(("Fz", Reason::Parent))),
        ("pose.x", Some(("Px", Reason::Parent))),
        ("x_m", Some(("Px", Reason::Words))),
        ("x", Some(("Px", Reason::Guess))),
        ("contact_x_mm", Some(("Px", Reason::Words))),
        ("Depth [mm]", Some(("Pz", Reason::MoreWords))),
        ("load_g", Some(("Fz", Reason::NoAxis))),
        ("normal_force", Some(("Fz", Reason::NoAxis))),
        ("Mx", Some(("Tx", Reason::Name))),
        ("F", Some(("Fz", Reason::NoAxis))),
        ("F1", None),
        ("m", None),
        ("temperature", None),
        ("note", None),
        ("foo_x", None),
        ("grid.x", None),
    ] {
        assert_eq!(Named::new(name).channel(), expected, "{name}");
    }
}

#[test]
fn a_unit_of_another_quantity_makes_no_channel_and_counts_leave_the_unit_open() {
    let of = |name: &str| Named::new(name).candidate(String::new());
    assert!(matches!(of("pos_x_deg"), Some(Err(Exclusion::Unit(_)))));
    assert!(matches!(of("x_rad"), None | Some(Err(_))));
    let counts = of("resultant_fx_lsb").expect("a name of a force");
    assert_eq!(counts.expect("a channel").unit, None);
    let named = of("Tz (lbf-in)").expect("a torque").expect("a channel");
    assert_eq!(named.unit, Some(("lbf-in", UnitSource::Name)));
    let named = of("joint_torque_x_nm");
    assert!(matches!(named, Some(Err(Exclusion::Word { .. }))));
}

#[test]
fn the_words_of_the_number_itself_come_before_those_of_what_it_is_part_of() {
    let of = |column: &str, element: &str| {
        let named = Named::within(column, element);
        named.candidate("[0]".to_owned()).and_then(Result::ok)
    };
    let found = |column: &str, element: &str| of(column, element).map(|found| found.channel);
    assert_eq!(found("observation.force", "x"), Some("Fx"));
    assert_eq!(found("observation.force", "torque_x"), Some("Tx"));
    assert_eq!(found("observation.state", "Fz"), Some("Fz"));
    assert_eq!(found("observation.state", "joint_1.pos"), None);
    assert_eq!(found("observation.acceleration", "x"), None);
    assert_eq!(found("observation.velocity", "z"), None);
    let unit = of("state_N", "Fz_mN").and_then(|found| found.unit);
    assert_eq!(unit, Some(("mN", UnitSource::Name)));
}
