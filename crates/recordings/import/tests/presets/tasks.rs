//! Expected results of the layouts with labels of tasks.

use super::Expected;

/// Expected result of each layout with labels of tasks. Positions of poses are stored in mm.
pub(super) const EXPECTED: [Expected; 6] = [
    Expected {
        preset: "touch-and-go",
        rows: 4,
        channels: &[],
        numbers: &[],
        // The list of test pictures comes first.
        pictures: &[0, 2, 1, 3],
        point: Some("20220516_190814"),
        attributes: &[
            ("clip", 1, "20220517_192217"),
            ("task.material", 0, "14"),
            ("task.material", 3, "4"),
            ("source_table", 2, "train.txt"),
        ],
        time: None,
    },
    Expected {
        preset: "feeling-of-success",
        rows: 3,
        channels: &[],
        numbers: &[],
        pictures: &[0, 1, 2],
        point: Some("000:0"),
        attributes: &[
            ("task.held", 0, "held"),
            ("task.held", 1, "lost"),
            ("file", 2, "001"),
        ],
        time: None,
    },
    Expected {
        preset: "objectfolder-benchmark",
        rows: 3,
        channels: &[],
        numbers: &[],
        pictures: &[0, 1, 2],
        point: Some("1:0"),
        attributes: &[
            ("task.material", 1, "3"),
            ("task.material", 2, "6"),
            ("object", 2, "2"),
        ],
        time: None,
    },
    Expected {
        preset: "tactile-tracking",
        rows: 3,
        channels: &[],
        // The turn of the second picture is about z, with the cosine 0.8.
        numbers: &[
            (1, "task.moved.x", 2000.0),
            (2, "task.moved.y", 5000.0),
            (0, "task.moved.qw", 1.0),
            (1, "task.moved.qz", 0.316_227_766_016_837_94),
        ],
        pictures: &[0, 1, 2],
        point: Some("avocado:1"),
        attributes: &[("object", 0, "avocado")],
        time: None,
    },
    Expected {
        preset: "sparsh-pose",
        rows: 3,
        channels: &[],
        numbers: &[
            (1, "task.moved.x", 2.0),
            (2, "task.moved.y", 5.0),
            (0, "task.moved.qw", 1.0),
            (1, "task.moved.qz", 0.316_227_766_016_837_94),
        ],
        pictures: &[0, 1, 2],
        point: Some("test:sugar:00"),
        attributes: &[("object", 0, "sugar"), ("part", 2, "train")],
        time: None,
    },
    Expected {
        preset: "active-clothing",
        rows: 3,
        channels: &[],
        numbers: &[],
        pictures: &[0, 1, 2],
        point: Some("1:1"),
        attributes: &[
            ("task.textile", 1, "3"),
            ("task.textile", 2, "6"),
            ("cloth", 2, "2"),
            ("trial", 2, "3"),
        ],
        time: None,
    },
];
