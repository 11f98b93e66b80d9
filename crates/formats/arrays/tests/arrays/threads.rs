//! Tests of one open file that several threads read at the same time.

use taceva_arrays::{ArrayFile, ArrayFormat};

use crate::digest::at;

#[test]
fn threads_that_share_a_file_read_the_same_rows() {
    let of_hdf5: &[(&str, &str)] = if cfg!(feature = "hdf5") {
        &[
            ("hdf5-gzip-shuffle-earliest/run.h5", "/tactile/left/rgb"),
            ("hdf5-vlen-compound/run.h5", "/image_png"),
        ]
    } else {
        &[]
    };
    let others = [
        ("npy-fortran/frames.npy", "value"),
        ("npz-stored/run.npz", "images"),
        ("npz-deflated/run.npz", "images"),
        ("zarr-v2/run.zarr", "camera_blosc"),
        ("pickle/p4.pkl", "images"),
    ];
    for (name, array) in others.iter().chain(of_hdf5) {
        let path = at(name);
        let format = ArrayFormat::of(&path).expect("known");
        let file = ArrayFile::open(&path, format).expect("opens");
        let alone: Vec<_> = (0..24)
            .map(|row| file.read(array, row..row + 1).expect("reads"))
            .collect();
        let fresh = ArrayFile::open(&path, format).expect("opens");
        std::thread::scope(|scope| {
            for thread in 0..4 {
                let (fresh, alone) = (&fresh, &alone);
                scope.spawn(move || {
                    for step in 0..96_u64 {
                        // Each thread in another order, forwards and backwards.
                        let row = (step * [1, 5, 23, 19][thread]) % 24;
                        let read = fresh.read(array, row..row + 1).expect("reads");
                        assert!(
                            read == alone[usize::try_from(row).expect("small")],
                            "{name} row {row}"
                        );
                    }
                });
            }
        });
    }
}
