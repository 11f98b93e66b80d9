//! Tests of `ati/netft` with the emulated box, over sockets.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream, UdpSocket};
use std::time::{Duration, Instant};

use taceva_conformance::{self as conformance, Trial};
use taceva_core::{Deadline, DriverError, ErrorKind, Factory, ForceTransducer, Rig};
use taceva_drivers::ati::netft::NetftFactory;
use taceva_wire::netft::{self, Emulator};
use taceva_wire::{BenchOptions, Device, FaultKind, WallBench};

use crate::waiting::support::{MOMENT, inject};

struct Setup {
    bench: WallBench,
    emulator: Emulator,
}

fn setup() -> Setup {
    set_up(netft::Setup::PLAIN)
}

fn set_up(settings: netft::Setup) -> Setup {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let emulator = Emulator::set_up(&bench, Ipv4Addr::LOCALHOST, 0, 0, settings).expect("a box");
    Setup { bench, emulator }
}

fn opened(arguments: &str) -> Result<Box<dyn ForceTransducer>, DriverError> {
    let factory = NetftFactory::new().expect("a factory");
    let args = factory.descriptor().args(arguments).expect("good");
    factory.open(&args, &mut Rig::new())
}

impl Setup {
    fn arguments(&self) -> String {
        let [port, page] =
            [self.emulator.address(), self.emulator.page_address()].map(|address| address.port());
        format!("host=127.0.0.1;port={port};page_port={page};force_max_n=50")
    }

    fn started(&self) -> Box<dyn ForceTransducer> {
        let mut transducer = opened(&self.arguments()).expect("a box");
        transducer.start(MOMENT).expect("it starts");
        transducer
    }

    /// Error message of a box that does not open with the additional driver arguments `more`.
    fn refused(&self, more: &str) -> String {
        match opened(&format!("{}{more}", self.arguments())) {
            Ok(_) => panic!("opened a box that contradicts its selector"),
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::InvalidArgument);
                error.to_string()
            }
        }
    }
}

#[test]
fn a_turned_tool_frame_is_refused_unless_it_is_wanted_and_is_then_a_setting() {
    let setup = set_up(netft::Setup {
        tool: [0.0, 0.0, 0.0, 90.0, 0.0, 45.0],
        ..netft::Setup::PLAIN
    });
    let refused = setup.refused("");
    assert!(refused.contains("0;0;0;90;0;45 (mm, degrees)"), "{refused}");
    let wanted = opened(&format!("{};frame=tool", setup.arguments())).expect("wanted");
    let settings = wanted.settings();
    assert_eq!(settings["frame"], "tool 0;0;0;90;0;45 (mm, degrees)");
    assert_eq!(settings["serial"], setup.bench.serial());
}

#[test]
fn a_box_of_another_rate_or_a_smaller_range_is_refused() {
    let setup = setup();
    let refused = setup.refused(";rate=1000");
    assert!(refused.contains("write `rate=500`"), "{refused}");
    opened(&format!("{};rate=500", setup.arguments())).expect("its rate");
    let arguments = setup.arguments();
    let wide = format!("{:?}", 2.0 * setup.bench.force_range_n());
    let wide = arguments.replace("force_max_n=50", &format!("force_max_n={wide}"));
    let Err(error) = opened(&wide) else {
        panic!("a range beyond that of the box")
    };
    assert!(error.to_string().contains("write `force_max_n="), "{error}");
}

#[test]
fn a_low_pass_is_a_setting_and_its_delay_a_warning() {
    let setup = set_up(netft::Setup {
        filter: 8,
        ..netft::Setup::PLAIN
    });
    let transducer = setup.started();
    assert_eq!(transducer.settings()["filter"], "8");
    let warnings = transducer.warnings();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].contains("about 31.8 ms"), "{warnings:?}");
}

#[test]
fn a_latched_threshold_is_a_warning_and_any_other_word_an_error_by_name() {
    let setup = setup();
    let mut transducer = setup.started();
    transducer.read(MOMENT).expect("a reading");
    assert_eq!(transducer.warnings(), Vec::<String>::new());
    setup.emulator.set_status(0x8001_0000);
    std::thread::sleep(Duration::from_millis(20));
    for _ in 0..20 {
        transducer.read(MOMENT).expect("valid");
    }
    let warnings = transducer.warnings();
    assert!(
        warnings.len() == 1 && warnings[0].contains("latched"),
        "{warnings:?}"
    );
    // Without the bit of any error.
    setup.emulator.set_status(0x0000_0020);
    std::thread::sleep(Duration::from_millis(20));
    let error = (0..5).find_map(|_| transducer.read(MOMENT).err());
    let error = error.expect("an error of the box");
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
    let said = error.to_string();
    assert!(
        said.contains("supply of the analog board too low (bit 5)"),
        "{said}"
    );
}

/// Opens the emulated box with a settings page that `changed` makes from its own page. The page includes the head of the HTTP answer.
fn opened_with_page(changed: impl FnOnce(String) -> Vec<u8>) -> Result<(), DriverError> {
    let setup = setup();
    let mut stream = TcpStream::connect(setup.emulator.page_address()).expect("a page");
    let request = b"GET /netftapi2.xml HTTP/1.0\r\n\r\n";
    stream.write_all(request).expect("sent");
    let mut page = String::new();
    stream.read_to_string(&mut page).expect("a page");
    let page = changed(page);
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().expect("a client");
        let _ = stream.read(&mut [0; 1024]);
        let _ = stream.write_all(&page);
    });
    let own = format!("page_port={}", setup.emulator.page_address().port());
    let arguments = setup
        .arguments()
        .replace(&own, &format!("page_port={port}"));
    let mut transducer = opened(&arguments)?;
    transducer.start(MOMENT)?;
    transducer.read(MOMENT).map(drop)
}

/// `page` with `to` in place of `from`.
fn replaced(page: &str, from: &str, to: &str) -> String {
    assert!(page.contains(from), "{from}");
    page.replace(from, to)
}

#[test]
fn a_page_of_a_box_that_is_cut_off_is_refused_as_incomplete() {
    for part in [3, 7, 9] {
        let error = opened_with_page(|page| page.as_bytes()[..page.len() * part / 10].to_vec());
        let error = error.expect_err("cut off");
        assert_eq!(error.kind(), ErrorKind::Protocol, "{error}");
        assert!(error.to_string().contains("incomplete"), "{error}");
    }
}

#[test]
fn a_page_of_a_box_with_entities_and_bytes_of_latin_1_is_read() {
    for unit in [&b"N&#183;m"[..], b"N&middot;m", b"N&#xB7;m", b"N\xb7m"] {
        let read = opened_with_page(|page| {
            let page = replaced(&page, "<scfgfu>N<", "<scfgfu>&#78;<");
            let (before, behind) = page.split_once("<scfgtu>Nm<").expect("a unit");
            [
                before.as_bytes(),
                b"<scfgtu>",
                unit,
                b"<",
                behind.as_bytes(),
            ]
            .concat()
        });
        read.unwrap_or_else(|error| panic!("{unit:?}: {error}"));
    }
}

#[test]
fn a_page_of_a_box_of_another_language_is_refused_by_its_entry() {
    for (from, to, words) in [
        (
            "<cfgcpf>10000000<",
            "<cfgcpf>10000000,0<",
            "`cfgcpf` in /netftapi2.xml is `10000000,0`",
        ),
        (
            "<cfgcpf>10000000<",
            "<cfgcpf>10.000.000<",
            "`cfgcpf` in /netftapi2.xml is `10.000.000`",
        ),
        (
            "<scfgfu>N<",
            "<scfgfu>牛顿<",
            "`scfgfu` in /netftapi2.xml is `牛顿`",
        ),
        (
            "<cfgtfx>0;0;0;0;0;0<",
            "<cfgtfx>0,0;0,0;0,0;0,0;0,0;0,0<",
            "`cfgtfx` in /netftapi2.xml is",
        ),
    ] {
        let error = opened_with_page(|page| replaced(&page, from, to).into_bytes());
        let error = error.expect_err(to);
        assert_eq!(error.kind(), ErrorKind::Protocol, "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn a_request_of_three_records_gets_three() {
    let setup = setup();
    let client = UdpSocket::bind("127.0.0.1:0").expect("a port");
    client.connect(setup.emulator.address()).expect("a box");
    let patience = Some(Duration::from_millis(500));
    client.set_read_timeout(patience).expect("a timeout");
    client.send(&[0x12, 0x34, 0, 2, 0, 0, 0, 3]).expect("sent");
    let mut record = [0; 64];
    for _ in 0..3 {
        assert_eq!(client.recv(&mut record).expect("a record"), 36);
    }
    assert!(client.recv(&mut record).is_err(), "a fourth record");
}

#[test]
fn the_suite_passes() {
    let setup = setup();
    let factory = NetftFactory::new().expect("a factory");
    let trial = Trial::with_arguments(setup.arguments());
    let report = conformance::force(&factory, &trial);
    assert!(report.passed(), "{report}");
}

#[test]
fn a_silent_box_is_a_timeout_that_says_what_was_missing_and_one_that_comes_back_goes_on() {
    let setup = setup();
    let mut transducer = setup.started();
    transducer.read(MOMENT).expect("a reading");
    inject(&setup.bench, Device::Force, FaultKind::Drop, 50);
    std::thread::sleep(Duration::from_millis(60));
    transducer.read(MOMENT).expect("it is back");
    transducer.read(MOMENT).expect("it goes on");
    inject(&setup.bench, Device::Force, FaultKind::Silent, 200);
    let patience = Deadline::after(Duration::from_millis(40));
    let silent = (0..5).find_map(|_| transducer.read(patience).err());
    let silent = silent.expect("nothing came");
    assert_eq!(silent.kind(), ErrorKind::Timeout);
    assert!(
        !silent.to_string().contains("; 0 earlier readings"),
        "{silent}"
    );
    transducer.read(MOMENT).expect("it is back");
}

#[test]
fn an_error_of_the_box_is_a_fault_of_that_reading_alone() {
    let setup = setup();
    let mut transducer = setup.started();
    inject(&setup.bench, Device::Force, FaultKind::NotANumber, 60);
    let until = Instant::now() + Duration::from_millis(40);
    let mut faults = 0;
    while Instant::now() < until {
        if let Err(error) = transducer.read(MOMENT) {
            assert_eq!(error.kind(), ErrorKind::DeviceFault);
            faults += 1;
        }
    }
    assert!(faults > 0);
    std::thread::sleep(Duration::from_millis(40));
    transducer.read(MOMENT).expect("a reading again");
}

#[test]
fn datagrams_of_others_torn_ones_and_those_that_come_twice_or_late_are_no_readings() {
    let setup = setup();
    // A box that accepts a start and then sends invalid records; the emulated one serves the page.
    let false_box = UdpSocket::bind("127.0.0.1:0").expect("a port");
    let port = false_box.local_addr().expect("bound").port();
    let page = setup.emulator.page_address().port();
    let arguments = format!("host=127.0.0.1;port={port};page_port={page}");
    let mut transducer = opened(&arguments).expect("a box");
    transducer.start(MOMENT).expect("it starts");
    let mut request = [0; 64];
    let (length, client) = false_box.recv_from(&mut request).expect("asked");
    assert_eq!(&request[..length], [0x12, 0x34, 0, 2, 0, 0, 0, 0]);
    let send = |from: &UdpSocket, bytes: &[u8]| {
        from.send_to(bytes, client).expect("sent");
    };
    let stranger = UdpSocket::bind("127.0.0.1:0").expect("a port");
    let mut record = [0; 36];
    record[3] = 9;
    send(&stranger, &record);
    send(&false_box, &record[..35]);
    send(&false_box, &[0; 4000]);
    let nothing = transducer.read(Deadline::after(Duration::from_millis(100)));
    assert_eq!(nothing.expect_err("no record").kind(), ErrorKind::Timeout);
    send(&false_box, &record);
    transducer.read(MOMENT).expect("a record");
    send(&false_box, &record);
    record[3] = 8;
    send(&false_box, &record);
    let again = transducer.read(Deadline::after(Duration::from_millis(100)));
    assert_eq!(again.expect_err("twice").kind(), ErrorKind::Timeout);
    record[3] = 10;
    record[9] = 2;
    send(&false_box, &record);
    let clipped = transducer.read(MOMENT).expect_err("clipped");
    assert_eq!(clipped.kind(), ErrorKind::OutOfRange);
}

#[test]
fn a_box_that_goes_away_is_disconnected_or_silent() {
    let setup = setup();
    let mut transducer = setup.started();
    transducer.read(MOMENT).expect("a reading");
    drop(setup);
    let patience = Deadline::after(Duration::from_millis(100));
    let gone = (0..1_000).find_map(|_| transducer.read(patience).err());
    let kind = gone.expect("gone").kind();
    // Systems differ in reporting a closed port.
    assert!([ErrorKind::Disconnected, ErrorKind::Timeout].contains(&kind));
}

#[test]
fn whoever_gives_no_calibration_is_not_opened() {
    let Err(error) = opened("host=127.0.0.1;page_port=1") else {
        panic!("opened nothing")
    };
    assert_eq!(error.kind(), ErrorKind::NotFound);
}
