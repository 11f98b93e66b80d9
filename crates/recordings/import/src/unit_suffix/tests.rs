use super::*;

fn said(name: &str) -> Option<(String, Vec<&'static str>)> {
    let found = UnitSuffix::of(name)?;
    let symbols = found.units.iter().map(SourceUnit::symbol).collect();
    Some((found.base, symbols))
}

#[test]
fn units_stand_in_brackets_behind_separators_and_as_words() {
    for (name, base, units) in [
        ("Fz (mN)", "Fz", &["mN"][..]),
        ("Fz(lbf)", "Fz", &["lbf"]),
        ("Fz [mN]", "Fz", &["mN"]),
        ("Force X (N)", "Force X", &["N"]),
        ("Depth [mm]", "Depth", &["mm"]),
        ("Tz (lbf-in)", "Tz", &["lbf-in"]),
        ("Tz [N·mm]", "Tz", &["N·mm"]),
        ("Mz [N.m]", "Mz", &["Nm"]),
        ("Fz_mN", "Fz", &["mN"]),
        ("Fz/mN", "Fz", &["mN"]),
        ("Fz, mN", "Fz", &["mN"]),
        ("Fz-gf", "Fz", &["gf"]),
        ("Fz N", "Fz", &["N"]),
        ("contact_x_mm", "contact_x", &["mm"]),
        ("pose_z_mm", "pose_z", &["mm"]),
        ("pose_mm.x", "pose.x", &["mm"]),
        ("/wrench_mN/force/x", "/wrench/force/x", &["mN"]),
        ("force_newtons", "force", &["N"]),
        ("Fz_N_filtered", "Fz_filtered", &["N"]),
        ("Fz_mN_raw", "Fz_raw", &["mN"]),
        ("torque_N_m", "torque", &["Nm"]),
        ("taxel_forces_n", "taxel_forces", &["N"]),
        ("joint_torque_nm", "joint_torque", &["Nm", "nm"]),
        ("stamp_ns", "stamp", &["ns"]),
        ("pressure_psi", "pressure", &["psi"]),
        ("index_tip_fx_lsb", "index_tip_fx", &["count"]),
    ] {
        assert_eq!(
            said(name),
            Some((base.to_owned(), units.to_vec())),
            "{name}"
        );
    }
}

#[test]
fn names_without_a_unit_say_none() {
    for name in [
        "Fz",
        "force_z",
        "N",
        "m",
        "pose_1",
        "ft",
        "force (raw)",
        "temperature",
        "x_m_y",
        "mass",
        "in",
        "z_in",
        "(N)",
        "100%",
        "Fz_MN",
    ] {
        assert_eq!(said(name), None, "{name}");
    }
}

#[test]
fn a_map_contradicts_a_name_of_the_same_quantity_in_another_unit_and_counts_without_a_scale() {
    let of = |name: &str, map: &str| {
        let unit = SourceUnit::parse(map).expect("known");
        UnitSuffix::of(name).and_then(|suffix| suffix.contradiction(&unit))
    };
    for (name, map) in [
        ("Fz [mN]", "N"),
        ("Fz(lbf)", "N"),
        ("Fz_gf", "N"),
        ("Fz/mN", "N"),
        ("contact_x_mm", "m"),
        ("depth (um) ", "mm"),
        ("t(ms)", "s"),
        ("joint_torque_nm", "Nmm"),
        ("fx_lsb", "N"),
        ("Fz (V)", "N"),
        ("p_bar", "kPa"),
    ] {
        let problem = of(name, map).unwrap_or_default();
        assert!(problem.contains("` by its name"), "{name}: {problem}");
    }
    for (name, map) in [
        ("Fz [mN]", "mN"),
        ("Fz [N]", "Nm"),
        ("force (raw)", "N"),
        ("joint_torque_nm", "Nm"),
        ("depth_nm", "nm"),
        ("force_z_mN", "mN"),
        ("]", "N"),
        ("fx_lsb", "count"),
    ] {
        assert_eq!(of(name, map), None, "{name}");
    }
}
