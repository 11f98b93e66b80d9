//! Tests with files of other libraries. Values must equal those that the other library reads (`tests/data/make.py`).

mod damage;
#[cfg(feature = "hdf5")]
mod data_frames;
mod digest;
#[cfg(feature = "hdf5")]
mod hdf5;
#[cfg(feature = "hdf5")]
mod hdf5_writer;
mod held;
mod matlab;
mod peers;
mod pickle;
mod recordings;
mod refusals;
mod threads;
mod zarr;
