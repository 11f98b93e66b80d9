//! Tests that this crate reads the HDF5 files of its writer. h5py reads them in the tests of `taceva-import`.

use std::fs;

use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues, Hdf5Writer, Problem, WrittenElement};

#[test]
fn every_type_and_shape_is_read_back_with_its_attributes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("written.h5");
    let mut writer = Hdf5Writer::create(&path).expect("new");
    let mut put = |name: &str, element, shape: &[u64], bytes: &[u8]| {
        writer
            .begin(name, element, shape, &[("unit", "µN·m"), ("leer", "")])
            .expect(name);
        for part in bytes.chunks(5) {
            writer.write(part).expect(name);
        }
    };
    put(
        "u8",
        WrittenElement::U8,
        &[2, 3, 1, 1],
        &[1, 2, 3, 4, 5, 255],
    );
    put("u16", WrittenElement::U16, &[3], &[1, 0, 0, 1, 255, 255]);
    put("i64", WrittenElement::I64, &[1], &(-5_i64).to_le_bytes());
    put(
        "f32",
        WrittenElement::F32,
        &[2],
        &[0.1_f32, f32::NAN].map(f32::to_le_bytes).concat(),
    );
    put(
        "f64",
        WrittenElement::F64,
        &[2],
        &[-0.0_f64, 1e-300].map(f64::to_le_bytes).concat(),
    );
    put(
        "日本",
        WrittenElement::Text { bytes: 6 },
        &[3],
        "ä\0\0\0\0日本\0\0\0\0\0\0".as_bytes(),
    );
    put("nothing", WrittenElement::F64, &[0, 4], &[]);
    let long = "x".repeat(100_000);
    writer.finish(&[("long", &long)]).expect("whole");

    let file = ArrayFile::open(&path, ArrayFormat::Hdf5).expect("a file");
    let read = |name: &str| {
        let rows = file.info(name).expect(name).rows();
        file.read(name, 0..rows).expect(name)
    };
    assert_eq!(read("u8").values, ArrayValues::U8(vec![1, 2, 3, 4, 5, 255]));
    assert_eq!(file.info("u8").expect("there").shape, [2, 3, 1, 1]);
    assert_eq!(read("u16").values, ArrayValues::U16(vec![1, 256, 65535]));
    assert_eq!(read("i64").values, ArrayValues::I64(vec![-5]));
    let ArrayValues::F32(single) = read("f32").values else {
        panic!("single precision");
    };
    assert!(single[0].to_bits() == 0.1_f32.to_bits() && single[1].is_nan());
    let ArrayValues::F64(double) = read("f64").values else {
        panic!("double precision");
    };
    assert_eq!(
        double
            .iter()
            .map(|number| number.to_bits())
            .collect::<Vec<_>>(),
        [(-0.0_f64).to_bits(), 1e-300_f64.to_bits()]
    );
    assert_eq!(
        read("日本").values,
        ArrayValues::Text(["ä", "日本", ""].map(str::to_owned).to_vec())
    );
    assert_eq!(file.info("nothing").expect("there").shape, [0, 4]);
    assert_eq!(file.attribute("f64", "unit").as_deref(), Some("µN·m"));
    assert_eq!(file.attribute("/", "long").as_deref(), Some(long.as_str()));
}

#[test]
fn what_cannot_be_written_is_refused_and_what_is_not_whole_is_no_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("written.h5");
    let mut writer = Hdf5Writer::create(&path).expect("new");
    let again = Hdf5Writer::create(&path).expect_err("there").to_string();
    assert!(again.contains("cannot create"), "{again}");
    for name in ["", "a/b", "a\0"] {
        let refused = writer.begin(name, WrittenElement::U8, &[1], &[]);
        assert!(matches!(
            refused.expect_err("a name").problem,
            Problem::Unsupported { .. }
        ));
    }
    let huge = writer.begin("a", WrittenElement::F64, &[u64::MAX, 2], &[]);
    assert!(
        huge.expect_err("beyond")
            .to_string()
            .contains("exceeds 64 bits")
    );
    writer
        .begin("a", WrittenElement::U8, &[2], &[])
        .expect("begun");
    let more = writer.write(&[1, 2, 3]).expect_err("three").to_string();
    assert!(
        more.contains("`a`: byte 0: 3 bytes given, expected 2"),
        "{more}"
    );
    writer.write(&[1]).expect("one");
    let fewer = writer
        .begin("b", WrittenElement::U8, &[1], &[])
        .expect_err("one is missing")
        .to_string();
    assert!(fewer.contains("1 bytes given, expected 2"), "{fewer}");
    writer.finish(&[]).expect_err("one is missing");
    assert!(ArrayFile::open(&path, ArrayFormat::Hdf5).is_err());
    assert!(
        fs::read(&path)
            .expect("read")
            .iter()
            .take(8)
            .all(|byte| *byte == 0)
    );
}
