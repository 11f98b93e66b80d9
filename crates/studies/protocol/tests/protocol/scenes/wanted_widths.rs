//! Tests of the wanted widths of intervals.

use taceva_core::{Axes, Facts, ForceFacts, Newton};
use taceva_protocol::{Scene, WantedWidth};

use super::{GOOD, descriptor, planned, rig, with};

/// Lines to add to a scene that wants an interval of `score` with at most `width`.
fn wanted(score: &str, width: &str) -> String {
    format!("[metrics]\nwant_width = {{ \"{score}\" = \"{width}\" }}")
}

#[test]
fn a_wanted_width_is_read_as_a_share_with_or_without_a_space() {
    for written in ["12.5 %", "12.5%"] {
        let text = format!("{GOOD}{}\n", wanted("rmse.Pxy", written));
        let scene = Scene::parse("s.toml", &text).expect("reads");
        let expected = WantedWidth {
            metric: "rmse".to_owned(),
            channel: "Pxy".to_owned(),
            width: 0.125,
        };
        assert_eq!(scene.metrics.wanted_widths(), [expected]);
    }
    let none = Scene::parse("s.toml", GOOD).expect("reads");
    assert!(none.metrics.wanted_widths().is_empty());
}

#[test]
fn a_width_of_an_unknown_metric_or_channel_names_its_line_and_what_is_known() {
    assert_eq!(
        with(&wanted("rmsee.Fz", "10 %")),
        "s.toml, line 10: `rmsee`: unknown metric with a wanted width, did you mean `rmse`?; known: mae, rmse"
    );
    assert_eq!(
        with(&wanted("mae.Pxyz", "10 %")),
        "s.toml, line 10: `Pxyz`: unknown channel or plane, did you mean `Pxy`?; known: Px, Py, Pz, Fx, Fy, Fz, Pxy, Fxy"
    );
    assert_eq!(
        with(&wanted("mae", "10 %")),
        "s.toml, line 10: `mae` under `want_width` names no channel: expected METRIC.CHANNEL in quotes, such as \"mae.Fz\""
    );
}

#[test]
fn a_width_of_zero_percent_or_without_a_percentage_is_refused_with_its_line() {
    for written in [
        "0 %", "-10 %", "nan %", "1001 %", "inf %", "0.1", "ten %", "%", "",
    ] {
        let expected = format!(
            "s.toml, line 10: `want_width` of `mae.Fz` is `{written}`, expected a percentage above 0 % and up to 1000 %, such as \"10 %\""
        );
        assert_eq!(with(&wanted("mae.Fz", written)), expected);
    }
}

#[test]
fn a_width_of_a_score_that_no_study_computes_is_refused_with_the_reason() {
    assert_eq!(
        planned(&wanted("mae.Fz", "10 %"), rig()),
        "s.toml, line 10: `mae.Fz` can never apply: needs `prediction` ← needs a model: none chosen"
    );
    let model = "[model]\nname = \"ridge\"";
    let other = wanted("mae.Fz", "10 %") + "\nwant = [\"rmse\"]";
    assert_eq!(
        planned(&format!("{model}\n{other}"), rig()),
        "s.toml, line 12: `mae.Fz` can never apply: not requested"
    );
    let kept = planned(&format!("{model}\n{}", wanted("mae.Fxy", "10 %")), rig());
    assert!(kept.starts_with("plan  study"), "{kept}");
    let force = ForceFacts::default().with_axes(Axes::NORMAL);
    let force = Facts::Force(force.with_force_max(Newton(5.0)));
    let mut normal = rig();
    normal.force = Some(descriptor("sim/force-transducer", force));
    let absent = planned(&format!("{model}\n{}", wanted("mae.Fxy", "10 %")), normal);
    assert_eq!(
        absent,
        "s.toml, line 12: `mae.Fxy` can never apply: needs `Fx` ← needs a force transducer that measures it: the transducer of the scene does not"
    );
}

#[test]
fn fewer_points_at_most_than_planned_are_refused_with_their_line() {
    assert_eq!(
        with("[protocol.calibration]\npoints = 16\npoints_max = 10"),
        "s.toml, line 11: `points_max` is 10, expected a whole number from 16 to 1000000"
    );
}
