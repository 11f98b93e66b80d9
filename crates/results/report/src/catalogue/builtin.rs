//! Built-in catalogue files.

/// Files by name. A test compares this list with the folder.
pub(super) const FILES: &[(&str, &str)] = &[
    (
        "chromatouch.toml",
        include_str!("../../catalogue/chromatouch.toml"),
    ),
    ("deltact.toml", include_str!("../../catalogue/deltact.toml")),
    (
        "densetac-2-0.toml",
        include_str!("../../catalogue/densetac-2-0.toml"),
    ),
    (
        "digit-360.toml",
        include_str!("../../catalogue/digit-360.toml"),
    ),
    (
        "digit-pinki.toml",
        include_str!("../../catalogue/digit-pinki.toml"),
    ),
    ("digit.toml", include_str!("../../catalogue/digit.toml")),
    ("dtact.toml", include_str!("../../catalogue/dtact.toml")),
    ("eflesh.toml", include_str!("../../catalogue/eflesh.toml")),
    ("eval.toml", include_str!("../../catalogue/eval.toml")),
    ("f-touch.toml", include_str!("../../catalogue/f-touch.toml")),
    (
        "finger-sts.toml",
        include_str!("../../catalogue/finger-sts.toml"),
    ),
    (
        "fingervision.toml",
        include_str!("../../catalogue/fingervision.toml"),
    ),
    (
        "gelforce.toml",
        include_str!("../../catalogue/gelforce.toml"),
    ),
    (
        "gelsight.toml",
        include_str!("../../catalogue/gelsight.toml"),
    ),
    (
        "gelsightwm.toml",
        include_str!("../../catalogue/gelsightwm.toml"),
    ),
    ("gelslim.toml", include_str!("../../catalogue/gelslim.toml")),
    ("geltip.toml", include_str!("../../catalogue/geltip.toml")),
    ("hivtac.toml", include_str!("../../catalogue/hivtac.toml")),
    (
        "icub-fingertip.toml",
        include_str!("../../catalogue/icub-fingertip.toml"),
    ),
    ("insight.toml", include_str!("../../catalogue/insight.toml")),
    (
        "magictac.toml",
        include_str!("../../catalogue/magictac.toml"),
    ),
    (
        "minsight.toml",
        include_str!("../../catalogue/minsight.toml"),
    ),
    (
        "omnitact.toml",
        include_str!("../../catalogue/omnitact.toml"),
    ),
    (
        "pbr-design.toml",
        include_str!("../../catalogue/pbr-design.toml"),
    ),
    ("sparsh.toml", include_str!("../../catalogue/sparsh.toml")),
    ("spectac.toml", include_str!("../../catalogue/spectac.toml")),
    ("tac3d.toml", include_str!("../../catalogue/tac3d.toml")),
    ("taceva.toml", include_str!("../../catalogue/taceva.toml")),
    ("tactip.toml", include_str!("../../catalogue/tactip.toml")),
    (
        "thintact.toml",
        include_str!("../../catalogue/thintact.toml"),
    ),
    ("tirgel.toml", include_str!("../../catalogue/tirgel.toml")),
    ("uv-tac.toml", include_str!("../../catalogue/uv-tac.toml")),
    ("vistac.toml", include_str!("../../catalogue/vistac.toml")),
    (
        "vitactip.toml",
        include_str!("../../catalogue/vitactip.toml"),
    ),
    ("vpts.toml", include_str!("../../catalogue/vpts.toml")),
    (
        "vt-review.toml",
        include_str!("../../catalogue/vt-review.toml"),
    ),
];
