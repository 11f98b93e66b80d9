//! Built-in catalogue files.

/// Name and text of each catalogue file. A test compares this list with the folder.
pub(super) const FILES: &[(&str, &str)] = &[
    ("9dtact.toml", include_str!("../../catalogue/9dtact.toml")),
    (
        "allsight.toml",
        include_str!("../../catalogue/allsight.toml"),
    ),
    ("anyskin.toml", include_str!("../../catalogue/anyskin.toml")),
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
    (
        "dm-tac-w.toml",
        include_str!("../../catalogue/dm-tac-w.toml"),
    ),
    (
        "dm-tac-w2l.toml",
        include_str!("../../catalogue/dm-tac-w2l.toml"),
    ),
    ("dtact.toml", include_str!("../../catalogue/dtact.toml")),
    ("eflesh.toml", include_str!("../../catalogue/eflesh.toml")),
    ("eval.toml", include_str!("../../catalogue/eval.toml")),
    ("evetac.toml", include_str!("../../catalogue/evetac.toml")),
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
        "flexitac.toml",
        include_str!("../../catalogue/flexitac.toml"),
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
    (
        "gelslim-4-0.toml",
        include_str!("../../catalogue/gelslim-4-0.toml"),
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
        "interlink-fsr-402.toml",
        include_str!("../../catalogue/interlink-fsr-402.toml"),
    ),
    (
        "l3-f-touch.toml",
        include_str!("../../catalogue/l3-f-touch.toml"),
    ),
    (
        "magictac.toml",
        include_str!("../../catalogue/magictac.toml"),
    ),
    (
        "minsight.toml",
        include_str!("../../catalogue/minsight.toml"),
    ),
    ("mistac.toml", include_str!("../../catalogue/mistac.toml")),
    (
        "omnitact.toml",
        include_str!("../../catalogue/omnitact.toml"),
    ),
    (
        "papillarray.toml",
        include_str!("../../catalogue/papillarray.toml"),
    ),
    (
        "paxini-dp-l3530.toml",
        include_str!("../../catalogue/paxini-dp-l3530.toml"),
    ),
    (
        "paxini-dp-m2826.toml",
        include_str!("../../catalogue/paxini-dp-m2826.toml"),
    ),
    (
        "paxini-dp-s1813.toml",
        include_str!("../../catalogue/paxini-dp-s1813.toml"),
    ),
    (
        "paxini-dp-s2015.toml",
        include_str!("../../catalogue/paxini-dp-s2015.toml"),
    ),
    (
        "paxini-ip-s1610.toml",
        include_str!("../../catalogue/paxini-ip-s1610.toml"),
    ),
    (
        "pbr-design.toml",
        include_str!("../../catalogue/pbr-design.toml"),
    ),
    ("r-tac0.toml", include_str!("../../catalogue/r-tac0.toml")),
    ("reskin.toml", include_str!("../../catalogue/reskin.toml")),
    (
        "robotiq-tsf-85.toml",
        include_str!("../../catalogue/robotiq-tsf-85.toml"),
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
    (
        "xela-uscu-alha.toml",
        include_str!("../../catalogue/xela-uscu-alha.toml"),
    ),
    (
        "xela-uspa-44.toml",
        include_str!("../../catalogue/xela-uspa-44.toml"),
    ),
    (
        "xela-uspa-46.toml",
        include_str!("../../catalogue/xela-uspa-46.toml"),
    ),
    (
        "xense-g1.toml",
        include_str!("../../catalogue/xense-g1.toml"),
    ),
];
