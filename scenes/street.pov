// street.pov - what a camera on a car's roof sees all around, driving down a street: one frame of [Okumura Fig. 8].
//
//     povray-prefenv +Istreet.pov +Ostreet_.exr +FE +W512 +H256 +KFI1 +KFF48 +A0.05 +AM1 +R3 -J
//
// A lat-long picture, the right way round: what lies ahead of the car is in the middle.  It drives 8 m/s and steers a
// little from side to side, at 15 frames a second: frame 695 is 370 m from the first.  Every frame stands by itself, so
// any part of the sequence can be made, anywhere.  Lengths are in metres; the street runs along z.

#version 3.7;
global_settings {
  assumed_gamma 1
  ambient_light rgb <0.75, 0.9, 1.2>
}

#declare Seconds = frame_number / 15;
#declare Driven = 8 * Seconds;
#declare Street_Length = 400;

camera {
  spherical
  angle 360 180
  location 0
  look_at z
  rotate 14 * sin(2 * pi * Driven / 90) * y
  translate <1.5 + 0.5 * sin(2 * pi * Driven / 90 + pi / 2), 1.8, Driven>
}

// ---- sky and light ----

#declare To_Sun = vnormalize(<-0.55, 0.62, 0.5>);
light_source { To_Sun * 1e4 rgb <1.5, 1.35, 1.1> parallel point_at 0 }
fog { fog_type 2 distance 240 fog_offset 8 fog_alt 4 rgb <0.6, 0.68, 0.8> } // the far end fades, the sky does not

#declare Sun_X = To_Sun.x;
#declare Sun_Y = To_Sun.y;
#declare Sun_Z = To_Sun.z;
#declare Near_Sun = function { max(0, (Sun_X * x + Sun_Y * y + Sun_Z * z - 0.99) / 0.01) };
sky_sphere {
  pigment {
    gradient y
    color_map { [0 rgb <0.62, 0.7, 0.8>] [0.25 rgb <0.4, 0.58, 0.88>] [1 rgb <0.12, 0.28, 0.68>] }
  }
  pigment {
    wrinkles
    turbulence 0.4
    color_map { [0.5 rgbt <1, 1, 1, 1>] [0.9 rgbt <1.2, 1.17, 1.1, 0.2>] }
    scale <0.7, 0.22, 0.7>
  }
  pigment {
    function { Near_Sun(x, y, z) }
    color_map { [0 rgbt <1, 1, 1, 1>] [0.6 rgbt <1.6, 1.5, 1.3, 0.5>] [0.8 rgbt <12, 10, 8, 0>] }
  }
}

// ---- the ground ----

#declare Matt = finish { ambient 0.22 diffuse 0.65 };
#declare Asphalt = pigment { granite scale 0.7 color_map { [0 rgb 0.08] [1 rgb 0.2] } };
#declare Paving = pigment { brick rgb 0.28, rgb <0.5, 0.47, 0.42> brick_size <0.6, 1, 0.6> mortar 0.03 };

plane { y, 0 texture { pigment { Asphalt } finish { Matt } } }
#macro Line(X, Width)
  box {
    <X - Width / 2, 0, -Street_Length>, <X + Width / 2, 0.005, 2 * Street_Length>
    texture { pigment { rgb 0.75 } finish { Matt } }
  }
#end
Line(-3.8, 0.12)
Line(3.8, 0.12)
#for (I, -30, 2 * Street_Length / 8)
  box { <-0.08, 0, 8 * I>, <0.08, 0.005, 8 * I + 3> texture { pigment { rgb 0.8 } finish { Matt } } }
#end
#for (Side, -1, 1, 2)
  box {
    <Side * 4.5, 0, -Street_Length>, <Side * 8.5, 0.15, 2 * Street_Length>
    texture { pigment { Paving } finish { Matt } }
  }
#end

// ---- houses ----

// A facade's storeys are 3.2 m high, its windows as far apart as Step.
#macro Facade(Wall, Glass, Step)
  pigment {
    gradient y
    pigment_map {
      [0.30 rgb Wall]
      [0.30 gradient z scale Step pigment_map { [0.3 rgb Wall] [0.3 rgb Glass] [0.72 rgb Glass] [0.72 rgb Wall] }]
      [0.80 gradient z scale Step pigment_map { [0.3 rgb Wall] [0.3 rgb Glass] [0.72 rgb Glass] [0.72 rgb Wall] }]
      [0.80 rgb Wall]
    }
    scale <1, 3.2, 1>
  }
#end

#declare Lot = 13;
#macro House(Side, Place)
  #local Chance = seed(7919 * (Place + 100) + Side);
  #local Height = 3.2 * (2 + int(4.99 * rand(Chance))) + 0.6;
  #local Depth = 8.6 + 1.5 * rand(Chance);
  #local Hue = rand(Chance);
  #local Light = 0.35 + 0.45 * rand(Chance);
  #local Wall = Light * (Hue * <1, 0.62, 0.42> + (1 - Hue) * <0.85, 0.9, 1>);
  #local Gap = select(rand(Chance) - 0.18, 4, 0); // an alley now and then
  #if (rand(Chance) > 0.08)
    box {
      <Side * Depth, 0, Lot * Place + Gap>, <Side * 22, Height, Lot * (Place + 1) - 0.05>
      texture { Facade(Wall, <0.05, 0.07, 0.1>, Lot / (3 + int(2.99 * rand(Chance)))) finish { Matt } }
    }
    // shop front
    box {
      <Side * (Depth - 0.05), 0.4, Lot * Place + Gap + 1>, <Side * (Depth + 1), 2.7, Lot * (Place + 1) - 1>
      texture {
        pigment { rgb <0.9, 0.75, 0.5> * (0.2 + rand(Chance)) }
        finish { ambient 0 diffuse 0.2 emission 0.7 }
      }
    }
    #if (rand(Chance) > 0.4)
      box { // awning
        <Side * (Depth - 1.6), 2.8, Lot * Place + Gap + 0.7>, <Side * Depth, 2.95, Lot * (Place + 1) - 0.7>
        texture { pigment { rgb <rand(Chance), 0.25, rand(Chance)> } finish { Matt } }
      }
    #end
  #end
#end

#for (Place, -int(Street_Length / 2 / Lot), int(2 * Street_Length / Lot))
  House(-1, Place)
  House(1, Place)
#end

// ---- what stands at the kerb ----

#declare Metal = texture { pigment { rgb 0.12 } finish { Matt } };
#macro Lamp(Side, Z)
  cylinder { <Side * 5, 0, Z>, <Side * 5, 6, Z>, 0.09 texture { Metal } }
  cylinder { <Side * 5, 6, Z>, <Side * 3.4, 6.3, Z>, 0.06 texture { Metal } }
  sphere {
    <Side * 3.4, 6.2, Z>, 0.28
    texture { pigment { rgb <1, 0.95, 0.8> } finish { ambient 0 diffuse 0 emission 3 } }
  }
#end

#macro Tree(Side, Z)
  #local Chance = seed(31 * Z + 1000 + Side);
  cylinder {
    <Side * 5.6, 0, Z>, <Side * 5.6, 3, Z>, 0.16
    texture { pigment { rgb <0.2, 0.13, 0.08> } finish { Matt } }
  }
  #for (I, 0, 8)
    sphere {
      <Side * (5.6 + 1.8 * (rand(Chance) - 0.5)), 3.2 + 2 * rand(Chance), Z + 1.8 * (rand(Chance) - 0.5)>,
      0.6 + 0.5 * rand(Chance)
      texture {
        pigment { bumps color_map { [0.3 rgb <0.05, 0.16, 0.04>] [0.7 rgb <0.18, 0.36, 0.1>] } scale 0.25 }
        finish { Matt }
      }
    }
  #end
#end

#macro Parked_Car(Side, Z)
  #local Chance = seed(17 * Z + 5000 + Side);
  #local Paint = texture {
    pigment { rgb <rand(Chance), rand(Chance), rand(Chance)> * 0.8 }
    finish { ambient 0.3 diffuse 0.6 specular 0.6 roughness 0.02 }
  }
  #local Dark = texture { pigment { rgb 0.04 } finish { Matt } };
  union {
    box { <-0.85, 0.35, -2.1>, <0.85, 0.95, 2.1> texture { Paint } }
    box { <-0.75, 0.95, -1.2>, <0.75, 1.4, 1.1> texture { Dark } }
    box { <-0.76, 1.4, -1.1>, <0.76, 1.47, 1> texture { Paint } }
    cylinder { <-0.87, 0.32, -1.3>, <0.87, 0.32, -1.3>, 0.32 texture { Dark } }
    cylinder { <-0.87, 0.32, 1.3>, <0.87, 0.32, 1.3>, 0.32 texture { Dark } }
    translate <Side * 3.6 - 0.2 * Side, 0, Z>
  }
#end

#for (I, -8, 2 * Street_Length / 25)
  Lamp(1, 25 * I)
  Lamp(-1, 25 * I + 12)
  #if (mod(abs(I), 3) < 2)
    Tree(-1, 25 * I + 5)
    Tree(1, 25 * I + 17)
  #end
  #if (mod(abs(I), 4) != 1)
    Parked_Car(1, 25 * I + 7)
  #end
  #if (mod(abs(I), 5) != 2)
    Parked_Car(-1, 25 * I + 18)
    Parked_Car(-1, 25 * I + 24)
  #end
#end

// A bridge over the street every 120 m, the first soon: its shadow and its dark underside pass over everything.
#for (I, -1, 5)
  box {
    <-9, 6.8, 120 * I + 17>, <9, 8, 120 * I + 21>
    texture { pigment { rgb <0.45, 0.4, 0.36> } finish { Matt } }
  }
#end
