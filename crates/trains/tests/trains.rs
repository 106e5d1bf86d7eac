//! The bundled trains have the sums, lengths and numbers of axles that lists of other people and the standard print.

use ttb_trains::{ForceTrain, Signature, Spread, find, find_all, load_model, split};

fn one(name: &str) -> ForceTrain {
    let found = find(name).unwrap();
    assert_eq!(found.len(), 1, "{name}");
    found.into_iter().next().unwrap()
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-6 * b.abs().max(1.0), "{a} is not {b}");
}

#[test]
fn the_ten_trains_of_hslm_a_have_the_published_sums_and_lengths() {
    let sums = [8500.0, 9600.0, 8280.0, 8360.0, 7140.0, 7200.0, 7600.0, 7220.0, 7560.0, 7560.0];
    let lengths = [397.525, 398.525, 397.525, 394.525, 389.525, 382.525, 397.525, 387.525, 375.525, 388.525];
    let coaches = [18, 17, 16, 15, 14, 13, 13, 12, 11, 11];
    let trains = find("hslm-a").unwrap();
    assert_eq!(trains.len(), 10);
    for (i, train) in trains.iter().enumerate() {
        assert_eq!(train.name, format!("hslm-a{}", i + 1));
        assert_eq!(train.axles.len(), 2 * coaches[i] + 14);
        near(train.total(), 1e3 * sums[i]);
        near(train.length(), lengths[i]);
        // The rear is the front mirrored.
        let back = train.reversed();
        train.axles.iter().zip(&back.axles).for_each(|(a, b)| near(1.0 + a.x, 1.0 + b.x));
    }
}

#[test]
fn annex_d_has_the_sums_and_lengths_that_the_standard_prints() {
    let printed = [
        (6630.0, 262.10),
        (5300.0, 281.10),
        (9400.0, 385.52),
        (5100.0, 237.60),
        (21600.0, 270.30),
        (14310.0, 333.10),
        (10350.0, 196.50),
        (10350.0, 212.50),
        (2960.0, 134.80),
        (3600.0, 129.60),
        (11350.0, 198.50),
        (11350.0, 212.50),
    ];
    let speeds = [200.0, 160.0, 250.0, 250.0, 80.0, 100.0, 120.0, 100.0, 120.0, 120.0, 120.0, 100.0];
    for (i, (sum, length)) in printed.into_iter().enumerate() {
        let train = one(&format!("annex-d-{}", i + 1));
        near(train.total(), 1e3 * sum);
        near(train.buffers.unwrap(), length);
        near(train.max_speed.unwrap() * 3.6, speeds[i]);
    }
    assert_eq!(find("annex-d").unwrap().len(), 12);
}

#[test]
fn wagons_of_en_15528_have_the_mass_per_metre_of_their_class() {
    let classes = ["a", "b1", "b2", "c2", "c3", "c4", "d2", "d3", "d4", "d5", "e4", "e5"];
    let per_metre = [5.0, 5.0, 6.4, 6.4, 7.2, 8.0, 6.4, 7.2, 8.0, 8.8, 8.0, 8.8];
    for (class, tonnes) in classes.into_iter().zip(per_metre) {
        let wagon = one(&format!("en15528-{class}"));
        let found = wagon.total() / 9.81e3 / wagon.buffers.unwrap();
        assert!((found - tonnes).abs() < 0.02, "{class}: {found} t/m");
    }
    let six = one("en15528-d2x6");
    assert_eq!(six.axles.len(), 24);
    near(six.axles[4].x, 14.05);
    near(six.total(), 24.0 * 22.5 * 9810.0);
}

#[test]
fn real_trains_have_the_axles_of_their_sources() {
    let ice2 = one("ice2");
    assert_eq!(ice2.axles.len(), 56);
    near(ice2.total(), 8.0 * 195e3 + 48.0 * 112e3);
    near(ice2.length(), 350.52);
    let talgo = one("talgo350");
    assert_eq!(talgo.axles.len(), 40);
    near(talgo.length(), 181.60 + 174.45);
    near(talgo.axles[14].x, 146.36);
    let [single, double] = [one("ave-s100-single"), one("ave-s100")];
    assert_eq!((single.axles.len(), double.axles.len()), (26, 52));
    near(single.length(), 193.16);
    near(double.total(), 2.0 * single.total());
    let velaro = one("velaro-like");
    assert_eq!(velaro.axles.len(), 64);
    near(velaro.length(), 200.32 + 7.0 * 24.775 + 19.875);
}

#[test]
fn every_train_of_vehicles_is_a_train_of_their_static_axle_loads() {
    let ice3 = one("ice3");
    assert_eq!(ice3.axles.len(), 32);
    // physics: 9.81 (12000 + 1600 + 2400) and 9.81 (11000 + 1200 + 2400).
    near(ice3.axles[0].load, 156_960.0);
    near(ice3.axles[4].load, 143_226.0);
    near(ice3.coach.unwrap(), 24.775);
    assert_eq!(one("manchester").axles.len(), 4);
}

#[test]
fn every_train_names_its_source_and_how_sure_it_is() {
    for train in ttb_trains::names::TRAINS.iter() {
        assert!(train.source.len() > 15, "{}: {}", train.name, train.source);
        assert!(["secondary", "program"].contains(&train.verified.as_str()), "{}", train.name);
        assert!(train.axles.windows(2).all(|pair| pair[0].x < pair[1].x), "{}", train.name);
    }
    for name in ["lm71", "SW/0", "sw2"] {
        assert_eq!(load_model(name).unwrap().verified, "secondary");
    }
}

#[test]
fn hslm_b_takes_its_number_and_distance_and_a_list_keeps_its_comma() {
    let train = one("hslm-b:10,3.5");
    assert_eq!(train.axles.len(), 10);
    near(train.total(), 1.7e6);
    near(train.length(), 31.5);
    assert_eq!(one("HSLM-B:10x3.5"), train);
    assert_eq!(split("hslm-a, hslm-b:10,3.5,ice2"), ["hslm-a", "hslm-b:10,3.5", "ice2"]);
    let text = find("hslm-b:1,3.5").unwrap_err().to_string();
    assert!(text.contains("from 2 to 1000"), "{text}");
}

#[test]
fn unknown_names_are_refused_all_at_once_with_what_may_have_been_meant() {
    let text = find_all(["hslm-a11", "ice-2", "ice2"]).unwrap_err().to_string();
    assert_eq!(text.lines().count(), 2, "{text}");
    assert!(text.contains("hslm-a11") && text.contains("did you mean `hslm-a1"), "{text}");
    assert!(text.contains("did you mean `ice2`"), "{text}");
    assert_eq!(find_all(["hslm-a1", "hslm-a"]).unwrap().len(), 10);
}

#[test]
fn a_file_of_a_user_is_read_in_the_dialects_of_spreadsheets() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let plain = one(&write("mine.csv", "# a locomotive\nx,load\n0,195\n3.0,195\n"));
    assert_eq!((plain.name.as_str(), plain.axles.len()), ("mine", 2));
    near(plain.total(), 390e3);
    let comma = one(&write("comma.csv", "\u{feff}X;Load\r\n0;195\r\n3,0;195\r\n"));
    assert_eq!(comma.axles, plain.axles);
    // An offset of the first axle is not part of a train.
    assert_eq!(one(&write("later.csv", "load\tx\n195\t10\n195\t13\n")).axles, plain.axles);
    let json = write(
        "train.json",
        r#"{"name": "own", "max_speed_km_h": 200, "units": [{"gaps": [1.8, 2.6, 11.5, 2.6, 1.8], "loads": [110, 110, 110, 110], "count": 12}]}"#,
    );
    let own = one(&json);
    assert_eq!((own.name.as_str(), own.axles.len()), ("own", 48));
    near(own.buffers.unwrap(), 12.0 * 20.3);
    let both = write(
        "both.json",
        r#"{"source": "s", "trains": [{"name": "a", "axles": [[0, 1]]}, {"name": "b", "axles": [[0, 2]]}]}"#,
    );
    assert_eq!(find(&both).unwrap().len(), 2);
}

#[test]
fn all_problems_of_a_file_are_told_with_line_and_rule() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.csv");
    std::fs::write(&path, "x,load\n0,195000\n3,a\n2,100\n1,-5\n").unwrap();
    let text = find(&path.display().to_string()).unwrap_err().to_string();
    for part in ["line 2", "at most 2000 kN", "line 3", "must be numbers", "line 5", "must not fall"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let path = folder.path().join("bad.json");
    std::fs::write(&path, r#"{"units": [{"gaps": [1], "loads": 5}, {"gaps": [1, 2, 1], "loads": [5]}]}"#).unwrap();
    let text = find(&path.display().to_string()).unwrap_err().to_string();
    assert!(text.contains("$.units[0].gaps") && text.contains("1 loads for 2 axles"), "{text}");
    assert!(find("nowhere.csv").unwrap_err().to_string().contains("cannot be read"));
}

#[test]
fn the_signature_has_the_published_values() {
    let a1 = one("hslm-a1");
    let g = |train: &ForceTrain, damping, length| 1e-3 * Signature::new(train, damping).amplitude(length);
    assert!((g(&a1, 0.0, 18.0) - 7250.7).abs() < 0.05, "{}", g(&a1, 0.0, 18.0));
    assert!((g(&a1, 0.01, 18.0) - 3938.0).abs() < 0.05, "{}", g(&a1, 0.01, 18.0));
    let a10 = one("hslm-a10");
    assert!((g(&a10, 0.0, 27.0) - 5885.9).abs() < 0.05, "{}", g(&a10, 0.0, 27.0));
    // LIR on B25: L 25 m, 15 t/m, EI 30e9 N m², ζ 1 %.
    let f1 = std::f64::consts::PI / (2.0 * 625.0) * (30e9_f64 / 15e3).sqrt();
    for (name, speed, expected) in [("hslm-a1", 230.0, 5.625), ("hslm-a5", 281.5, 18.465), ("hslm-a3", 250.0, 9.202)] {
        let train = one(name);
        let found = Signature::new(&train, 0.01).lir(25.0, 15e3, f1, speed / 3.6);
        assert!((found / expected - 1.0).abs() < 1e-3, "{name}: {found}");
    }
}

#[test]
fn resonance_lengths_are_the_coach_and_its_parts() {
    let a1 = one("hslm-a1");
    let found = Signature::new(&a1, 0.01).resonances([4.5, 40.0]);
    assert!((found[0].length - 18.0).abs() < 0.1, "{found:?}");
    assert!(found.iter().any(|r| (r.length - 9.0).abs() < 0.1), "{found:?}");
}

#[test]
fn spread_loads_keep_sum_and_centre() {
    let train = one("ice2");
    let centre = |t: &ForceTrain| t.axles.iter().map(|a| a.x * a.load).sum::<f64>() / t.total();
    for spread in [Spread::Three { spacing: 0.65 }, Spread::Two { spacing: 0.6 }, Spread::Triangle { width: 2.5 }] {
        let wide = spread.of(&train);
        near(wide.total(), train.total());
        // x counts from the first part, which runs before the axle.
        near(centre(&wide) + spread.parts()[0][0], centre(&train));
    }
}
