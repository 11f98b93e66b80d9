//! What is known of each layout.

use super::Preset;

/// A file or folder without which a folder does not have the layout.
pub(super) struct Need {
    /// Any of these, relative to the folder; `*` stands for any characters within a name.
    pub(super) any_of: &'static [&'static str],
    pub(super) what: &'static str,
}

/// What is known of a layout.
pub(super) struct Layout {
    pub(super) name: &'static str,
    pub(super) layout: &'static str,
    pub(super) reads: &'static str,
    pub(super) leaves_open: &'static str,
    pub(super) needs: &'static [Need],
    /// A pattern that other folders lack, where what the layout needs is common.
    pub(super) mark: Option<&'static str>,
}

impl Preset {
    pub(super) const fn facts(self) -> &'static Layout {
        match self {
            Preset::Bristol => &Layout {
                name: "bristol",
                layout: "targets.csv, sensor_images/ (older: images/)",
                reads: "poses (mm, deg), shear, forces (N) where they are filled, image_0.png as the picture without contact",
                leaves_open: "no times; units are those of the robot library, the table states none",
                needs: &[Need {
                    any_of: &["targets.csv"],
                    what: "the table of poses",
                }],
                mark: None,
            },
            Preset::Py3dcal => &Layout {
                name: "py3dcal",
                layout: "annotations/probe_data.csv, probe_images/, blank_images/blank.png",
                reads: "the place of the probe (mm); rows named --- are left out",
                leaves_open: "no forces, no times",
                needs: &[Need {
                    any_of: &["annotations/probe_data.csv"],
                    what: "the table of places",
                }],
                mark: None,
            },
            Preset::NineDTact => &Layout {
                name: "9dtact",
                layout: "image/OBJECT/N.png, wrench/OBJECT/N.npy",
                reads: "six numbers of the wrench (N, N·m)",
                leaves_open: "no times, no presses; normed wrenches and lists of training are not read",
                needs: &[
                    Need {
                        any_of: &["image/*/*.png"],
                        what: "the pictures",
                    },
                    Need {
                        any_of: &["wrench/*/*.npy"],
                        what: "the wrenches",
                    },
                ],
                mark: None,
            },
            Preset::AllSight => &Layout {
                name: "allsight",
                layout: "GEL/LED/data/INDENTER/data_DATE/data_*.json, GEL/LED/images/INDENTER/SESSION/",
                reads: "forces, torques and place (N, N·m, m), gel, light, indenter, time since the press began",
                leaves_open: "units are assumed; a picture without contact a press is kept by name alone",
                needs: &[Need {
                    any_of: &["*/*/data/*/data_*/data_*.json"],
                    what: "the labels of a session",
                }],
                mark: None,
            },
            Preset::SparshForce => &Layout {
                name: "sparsh-force",
                layout: "SHAPE/batch_N/dataset_slip_forces.pkl, dataset_digit_NN.pkl (or dataset_gelsight_NN.pkl)",
                reads: "three forces (N) and slip of every press, pictures by their number through all pickles",
                leaves_open: "no times; pictures between presses are left out; the factors of the training are not applied",
                needs: &[
                    Need {
                        any_of: &["*/*/dataset_slip_forces.pkl"],
                        what: "the pickle of presses",
                    },
                    Need {
                        any_of: &["*/*/dataset_digit_*.pkl", "*/*/dataset_gelsight_*.pkl"],
                        what: "the pickles of pictures",
                    },
                ],
                mark: None,
            },
            Preset::YcbSlide => &Layout {
                name: "ycb-slide",
                layout: "OBJECT/dataset_N/synced_data.npy and the pictures that it names (the real half)",
                reads: "the place of the sensor (m), times (s)",
                leaves_open: "no forces; the clock is not stated; the pose of the object is not read",
                needs: &[Need {
                    any_of: &["*/dataset_*/synced_data.npy"],
                    what: "the dictionary of a recording",
                }],
                mark: None,
            },
            Preset::Touchd => &Layout {
                name: "touchd",
                layout: "all_data_direction.json, objN_speedN/SENSOR/image_N.png (or image_N_l.png)",
                reads: "three forces (N) and the action of one sensor, the first in the file",
                leaves_open: "no times; units are assumed, and which way Fz counts",
                needs: &[Need {
                    any_of: &["all_data_direction.json"],
                    what: "the forces",
                }],
                mark: None,
            },
            Preset::Tacquad => &Layout {
                name: "tacquad",
                layout: "contact_indoor.csv, data_indoor/ITEM/gelsight/N.png",
                reads: "the pictures of gelsight, the item, the first and the last number in contact",
                leaves_open: "no forces, no places, no times",
                needs: &[
                    Need {
                        any_of: &["contact_indoor.csv"],
                        what: "the table of contacts",
                    },
                    Need {
                        any_of: &["data_indoor/*/gelsight/*.png"],
                        what: "the pictures",
                    },
                ],
                mark: None,
            },
            Preset::PoseIt => &Layout {
                name: "poseit",
                layout: "OBJECT_SECOND_F80_pose8/ with gelsight/gelsight_N_SECOND.jpg, f_t.csv, stages.csv",
                reads: "forces and torques (N, N·m) of the same second, the stage, the object",
                leaves_open: "all clocks show whole seconds: of the 70 forces of a second the first is taken; units are assumed",
                needs: &[
                    Need {
                        any_of: &["*/gelsight/gelsight_*.jpg"],
                        what: "the pictures of a grasp",
                    },
                    Need {
                        any_of: &["*/f_t.csv"],
                        what: "the forces of a grasp",
                    },
                    Need {
                        any_of: &["*/stages.csv"],
                        what: "the stages of a grasp",
                    },
                ],
                mark: None,
            },
            Preset::ToolForce => &Layout {
                name: "tool-force",
                layout: "TRIAL/tactile1/tactile_frame_N.jpg, TRIAL/tactile2/, TRIAL/force/force_data_N.txt",
                reads: "Fz (N, by the line that their program converts with) and the pictures of tactile1",
                leaves_open: "no times; the pictures of tactile2 are not read",
                needs: &[
                    Need {
                        any_of: &["*/tactile1/tactile_frame_*.jpg"],
                        what: "the pictures of a trial",
                    },
                    Need {
                        any_of: &["*/force/force_data_*.txt"],
                        what: "the forces of a trial",
                    },
                ],
                mark: None,
            },
            Preset::UniVtac => &Layout {
                name: "univtac",
                layout: "EPISODE.hdf5 (also below hdf5/, clean/ or TASK/clean/) with /tactile/left_gsmini/ or /tactile/left_tactile/",
                reads: "the pictures and the pose (m) of the left gel",
                leaves_open: "simulated; no forces; units are assumed; frames before contact may be in contact",
                needs: &[Need {
                    any_of: UNIVTAC_FILES,
                    what: "an episode",
                }],
                mark: None,
            },
            Preset::LerobotV3 => &Layout {
                name: "lerobot-v3",
                layout: "meta/info.json, data/chunk-000/*.parquet, videos/ (versions 2.1 and 3.0)",
                reads: "states whose names say force, torque or place (N, N·m, m), the first video, times, task",
                leaves_open: "units are assumed; video loses detail unless its codec does not",
                needs: &[Need {
                    any_of: &["meta/info.json"],
                    what: "the description of the dataset",
                }],
                mark: None,
            },
            Preset::GelsightLive => &Layout {
                name: "gelsight-live",
                layout: "*.png, marker_tracking_DATE.npy or .csv",
                reads: "the pictures",
                leaves_open: "no force, no serial number, no time; which picture a row of markers belongs to",
                needs: &[Need {
                    any_of: &["*.png"],
                    what: "the pictures",
                }],
                mark: Some("marker_tracking_*"),
            },
            Preset::Fota => &Layout {
                name: "fota",
                layout: "data-NNNNNN.tar (or a folder of them a part), in each KEY.jpg and KEY.json",
                reads: "x_mm, y_mm, z_mm or label where the JSON has them, the shard; pictures where they lie in the tar",
                leaves_open: "no forces, no times; what else a JSON holds differs from set to set",
                needs: &[Need {
                    any_of: FOTA_FILES,
                    what: "a shard",
                }],
                mark: None,
            },
            Preset::Rosbag => &Layout {
                name: "rosbag",
                layout: "*.mcap of ROS 2 (.db3 and .bag: `mcap convert FILE OUT.mcap` first)",
                reads: "the first topic of pictures, and by time topics of forces, torques and places (N, N·m, m: REP 103)",
                leaves_open: "how much later one clock shows the same instant; other topics of pictures",
                needs: &[Need {
                    any_of: &["*.mcap"],
                    what: "a recording",
                }],
                mark: None,
            },
            Preset::DiffusionZarr => &Layout {
                name: "diffusion-zarr",
                layout: "data.zarr or another *.zarr with data/camera_0, data/force, meta/episode_ends",
                reads: "one camera, three forces (N), the episode of every step",
                leaves_open: "no times; units and the order of forces are assumed; actions are not read",
                needs: &[Need {
                    any_of: &["*.zarr"],
                    what: "a store",
                }],
                mark: None,
            },
        }
    }
}

/// Where episodes of UniVTAC lie.
pub(crate) const UNIVTAC_FILES: &[&str] =
    &["*.hdf5", "hdf5/*.hdf5", "clean/*.hdf5", "*/clean/*.hdf5"];
/// Where shards of FoTa lie.
pub(crate) const FOTA_FILES: &[&str] = &["data-*.tar", "*/data-*.tar"];
