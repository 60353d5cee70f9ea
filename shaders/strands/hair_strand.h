// Code header: the styling of a strand that grows in a bundle of a hair mesh. A strand is a curve through its
// bundle; clumping draws it towards the middle of its clump; curl, wave, kink, noise, frizz and fuzz displace
// it along the directions u and v. Everything is a function of the unstyled strand alone, so that the order
// of strands and points does not matter; every displacement is 0 at the root. Only + - * on numbers and
// integers decide, one rounding each, so that every machine makes the same bits; the only division is of a
// strand's own length.

// Lengths in metres, frequencies per metre. `rise` is 1 / the distance over which a displacement grows.
struct StrandStyle {
    real kept_length;  // part that is kept of all strands
    real cut;          // largest random shortening
    real cut_noise;
    real cut_frequency;
    real clump;
    real clump_start;
    real clump_rise;  // 1 / (1 - clump_start)
    real curl;
    real curl_frequency;
    real curl_rise;
    real curl_coherence;
    real wave;
    real wave_frequency;
    real wave_rise;
    real wave_spread;
    real wave_u;
    real wave_v;
    real kink;
    real kink_frequency;
    real kink_rise;
    real kink_spread;
    real kink_u;
    real kink_v;
    real noise;
    real noise_across;
    real noise_along;
    real frizz;
    real frizz_frequency;
    real rise;  // of noise and frizz
    real fuzz;
    real fuzz_share;
};

// What all points of a strand share.
struct StrandTraits {
    real u;
    real v;
    real kept;         // part of the length that is left
    real inverse_tip;  // 1 / w at the uncut tip
    real clump_base;   // what the clump's weight would be at the root
    real curl_frequency;
    real curl_phase;
    real wave_phase;
    real kink_phase;
    real fuzz_u;
    real fuzz_v;
    uint noise_seed;
    uint frizz_seed;
};

// 32 bits mixed (the constants are Wellons's "lowbias32").
FUNCTION uint mix_uint(uint x) {
    x += 0x9E3779B9u;
    x ^= x >> 16;
    x *= 0x7FEB352Du;
    x ^= x >> 15;
    x *= 0x846CA68Bu;
    x ^= x >> 16;
    return x;
}

FUNCTION uint combine(uint a, uint b) { return mix_uint(mix_uint(a) ^ b); }

// A number in [0, 1) that belongs to an id and a purpose.
FUNCTION real random_of(uint id, uint purpose) {
    PRECISE real x = real(combine(id, purpose) >> 8) * real(5.9604644775390625e-8);
    return x;
}

FUNCTION int floor_of(real x) {
    int k = int(x);
    return real(k) > x ? k - 1 : k;
}

// sin(2 pi x), within 1e-8 and the rounding.
FUNCTION real sine_of_turns(real x) {
    PRECISE real half_up = x + real(0.5);
    PRECISE real r = x - real(floor_of(half_up));
    PRECISE real folded = r > real(0.25) ? real(0.5) - r : (r < real(-0.25) ? real(-0.5) - r : r);
    PRECISE real z = folded * folded;
    PRECISE real a = real(39.7598270855719) * z + real(-76.58117264428098);
    PRECISE real b = a * z + real(81.60247636892414);
    PRECISE real c = b * z + real(-41.34168061334649);
    PRECISE real d = c * z + real(6.283185280154406);
    PRECISE real result = d * folded;
    return result;
}

// A wave of straight lines with the zeros and the height of the sine.
FUNCTION real triangle_of_turns(real x) {
    PRECISE real half_up = x + real(0.5);
    PRECISE real r = x - real(floor_of(half_up));
    PRECISE real folded = r > real(0.25) ? real(0.5) - r : (r < real(-0.25) ? real(-0.5) - r : r);
    PRECISE real result = real(4) * folded;
    return result;
}

// 0 below x = 0, 1 above x = 1, smooth between.
FUNCTION real smooth_rise(real x) {
    real t = clamp(x, real(0), real(1));
    PRECISE real double_t = real(2) * t;
    PRECISE real slope = real(3) - double_t;
    PRECISE real square = t * t;
    PRECISE real result = square * slope;
    return result;
}

FUNCTION real quintic(real t) {
    PRECISE real a = t * real(6) - real(15);
    PRECISE real b = t * a + real(10);
    PRECISE real cube = t * t * t;
    PRECISE real result = cube * b;
    return result;
}

// The component of a random gradient that 10 bits of a hash hold, in [-2, 2]: noise made of it reaches
// about 1.
FUNCTION real gradient_of(uint bits) {
    PRECISE real scaled = real(bits & 1023u) * real(0.00390625);
    PRECISE real centred = scaled - real(1.998046875);
    return centred;
}

// Gradient noise (Perlin 2002) of two channels is evaluated in planes k of its lattice: near a plane, channel
// c is a_c + b_c (z - k). The result is (a_1, b_1, a_2, b_2) at x, y.
FUNCTION real4 noise_plane(uint seed, real x, real y, int k) {
    int i = floor_of(x);
    int j = floor_of(y);
    PRECISE real fx = x - real(i);
    PRECISE real fy = y - real(j);
    real sx = quintic(fx);
    real sy = quintic(fy);
    PRECISE real4 sum = real4(real(0), real(0), real(0), real(0));
    for (int corner = 0; corner < 4; ++corner) {
        int right = corner & 1;
        int up = corner >> 1;
        uint hash = combine(combine(combine(seed, uint(i + right)), uint(j + up)), uint(k));
        uint second = mix_uint(hash);
        PRECISE real dx = fx - real(right);
        PRECISE real dy = fy - real(up);
        PRECISE real wx = right == 1 ? sx : real(1) - sx;
        PRECISE real wy = up == 1 ? sy : real(1) - sy;
        PRECISE real weight = wx * wy;
        PRECISE real first_x = gradient_of(hash) * dx;
        PRECISE real first_y = gradient_of(hash >> 10) * dy;
        PRECISE real second_x = gradient_of(second) * dx;
        PRECISE real second_y = gradient_of(second >> 10) * dy;
        PRECISE real first_a = weight * (first_x + first_y);
        PRECISE real second_a = weight * (second_x + second_y);
        PRECISE real first_b = weight * gradient_of(hash >> 20);
        PRECISE real second_b = weight * gradient_of(second >> 20);
        PRECISE real4 part = real4(first_a, first_b, second_a, second_b);
        sum = sum + part;
    }
    return sum;
}

// The same for noise along one line only.
FUNCTION real4 noise_knot(uint seed, int k) {
    uint hash = combine(seed, uint(k));
    return real4(real(0), gradient_of(hash), real(0), gradient_of(hash >> 10));
}

// Both channels at the fraction f between two planes.
FUNCTION real2 noise_between(real4 below, real4 above, real f) {
    real s = quintic(f);
    PRECISE real g = f - real(1);
    PRECISE real first_low = below.x + below.y * f;
    PRECISE real first_high = above.x + above.y * g;
    PRECISE real second_low = below.z + below.w * f;
    PRECISE real second_high = above.z + above.w * g;
    PRECISE real first = first_low + s * (first_high - first_low);
    PRECISE real second = second_low + s * (second_high - second_low);
    return real2(first, second);
}

// Traits of strand `id` in clump `clump_id`; u, v at its root, w at its tip. seed is the model's.
FUNCTION StrandTraits strand_traits(StrandStyle style, uint seed, uint id, uint clump_id, real u, real v,
                                    real tip_w) {
    StrandTraits traits;
    traits.u = u;
    traits.v = v;
    traits.noise_seed = combine(seed, 1u);
    traits.frizz_seed = combine(id, 2u);
    PRECISE real inverse_tip = real(1) / tip_w;
    traits.inverse_tip = inverse_tip;
    PRECISE real cut_u = u * style.cut_frequency;
    PRECISE real cut_v = v * style.cut_frequency;
    real4 shared_cut = noise_plane(combine(seed, 3u), cut_u, cut_v, 0);
    PRECISE real shortening = style.cut * random_of(id, 4u);
    PRECISE real shared_part = real(0.5) + real(0.5) * clamp(shared_cut.x, real(-1), real(1));
    PRECISE real shared_shortening = style.cut_noise * shared_part;
    PRECISE real rest = real(1) - shortening - shared_shortening;
    PRECISE real kept = style.kept_length * rest;
    traits.kept = max(kept, real(0.05));
    PRECISE real before_start = (real(0) - style.clump_start) * style.clump_rise;
    traits.clump_base = smooth_rise(before_start);
    PRECISE real jitter = real(0.9) + real(0.2) * random_of(clump_id, 5u);
    PRECISE real curl_frequency = style.curl_frequency * jitter;
    traits.curl_frequency = curl_frequency;
    PRECISE real own_phase = (real(1) - style.curl_coherence) * random_of(id, 6u);
    PRECISE real curl_phase = style.curl_coherence * random_of(clump_id, 7u) + own_phase;
    traits.curl_phase = curl_phase;
    PRECISE real wave_phase = style.wave_spread * random_of(clump_id, 8u);
    traits.wave_phase = wave_phase;
    PRECISE real kink_phase = style.kink_spread * random_of(clump_id, 9u);
    traits.kink_phase = kink_phase;
    bool flies = random_of(id, 10u) < style.fuzz_share;
    PRECISE real reach = flies ? style.fuzz * random_of(id, 11u) : real(0);
    real direction = random_of(id, 12u);
    PRECISE real quarter = direction + real(0.25);
    PRECISE real fuzz_u = reach * sine_of_turns(quarter);
    PRECISE real fuzz_v = reach * sine_of_turns(direction);
    traits.fuzz_u = fuzz_u;
    traits.fuzz_v = fuzz_v;
    return traits;
}

// How far the point at distance w from the root is drawn to the middle of its clump.
FUNCTION real clump_weight(StrandStyle style, StrandTraits traits, real w) {
    PRECISE real along = w * traits.inverse_tip;
    PRECISE real x = (along - style.clump_start) * style.clump_rise;
    PRECISE real grown = smooth_rise(x) - traits.clump_base;
    PRECISE real weight = style.clump * max(grown, real(0));
    return weight;
}

// Displacement along u and v at distance w from the root, given both noises there.
FUNCTION real2 displacement(StrandStyle style, StrandTraits traits, real w, real2 shared_noise,
                            real2 own_noise) {
    PRECISE real u = real(0);
    PRECISE real v = real(0);
    if (style.curl > real(0)) {
        PRECISE real grown = w * style.curl_rise;
        PRECISE real size = style.curl * smooth_rise(grown);
        PRECISE real phase = traits.curl_frequency * w + traits.curl_phase;
        PRECISE real quarter = phase + real(0.25);
        PRECISE real along_u = size * sine_of_turns(quarter);
        PRECISE real along_v = size * sine_of_turns(phase);
        u = u + along_u;
        v = v + along_v;
    }
    if (style.wave > real(0)) {
        PRECISE real grown = w * style.wave_rise;
        PRECISE real phase = style.wave_frequency * w + traits.wave_phase;
        PRECISE real size = style.wave * smooth_rise(grown);
        PRECISE real height = size * sine_of_turns(phase);
        PRECISE real along_u = height * style.wave_u;
        PRECISE real along_v = height * style.wave_v;
        u = u + along_u;
        v = v + along_v;
    }
    if (style.kink > real(0)) {
        PRECISE real grown = w * style.kink_rise;
        PRECISE real phase = style.kink_frequency * w + traits.kink_phase;
        PRECISE real size = style.kink * smooth_rise(grown);
        PRECISE real height = size * triangle_of_turns(phase);
        PRECISE real along_u = height * style.kink_u;
        PRECISE real along_v = height * style.kink_v;
        u = u + along_u;
        v = v + along_v;
    }
    PRECISE real grown = w * style.rise;
    real risen = smooth_rise(grown);
    PRECISE real shared_size = style.noise * risen;
    PRECISE real own_size = style.frizz * risen;
    PRECISE real shared_u = shared_size * shared_noise.x;
    PRECISE real shared_v = shared_size * shared_noise.y;
    PRECISE real own_u = own_size * own_noise.x;
    PRECISE real own_v = own_size * own_noise.y;
    PRECISE real along = w * traits.inverse_tip;
    PRECISE real square = along * along;
    PRECISE real fuzz_u = square * traits.fuzz_u;
    PRECISE real fuzz_v = square * traits.fuzz_v;
    u = u + shared_u;
    v = v + shared_v;
    u = u + own_u;
    v = v + own_v;
    u = u + fuzz_u;
    v = v + fuzz_v;
    return real2(u, v);
}

// Point of the cubic Bezier curve; exactly b0 and b3 at the ends.
FUNCTION real3 cubic_point(real3 b0, real3 b1, real3 b2, real3 b3, real s) {
    PRECISE real r = real(1) - s;
    PRECISE real r_square = r * r;
    PRECISE real s_square = s * s;
    PRECISE real weight_0 = r_square * r;
    PRECISE real weight_1 = real(3) * (r_square * s);
    PRECISE real weight_2 = real(3) * (s_square * r);
    PRECISE real weight_3 = s_square * s;
    PRECISE real3 first = b0 * weight_0 + b1 * weight_1;
    PRECISE real3 second = b2 * weight_2 + b3 * weight_3;
    PRECISE real3 result = first + second;
    return result;
}

// A blend of four columns.
FUNCTION real3 blend(real3 a, real3 b, real3 c, real3 d, real4 weights) {
    PRECISE real3 first = a * weights.x + b * weights.y;
    PRECISE real3 second = c * weights.z + d * weights.w;
    PRECISE real3 result = first + second;
    return result;
}

FUNCTION real between(real a, real b, real s) {
    PRECISE real result = a + (b - a) * s;
    return result;
}

// The styled point: `own` on the unstyled strand, `middle` on its clump's, directions at the layers around.
FUNCTION real3 styled_point(real3 own, real3 middle, real weight, real2 offset, real3 u_below, real3 u_above,
                            real3 v_below, real3 v_above, real s) {
    PRECISE real3 u = u_below + (u_above - u_below) * s;
    PRECISE real3 v = v_below + (v_above - v_below) * s;
    PRECISE real3 drawn = (middle - own) * weight;
    PRECISE real3 moved = own + drawn;
    PRECISE real3 along_u = u * offset.x;
    PRECISE real3 along_v = v * offset.y;
    PRECISE real3 sideways = along_u + along_v;
    PRECISE real3 result = moved + sideways;
    return result;
}

// The curve through the styled points is the uniform Catmull-Rom one whose end pieces are parabolas. A third
// of the derivative at a point between two others ...
FUNCTION real4 inner_step(real4 before, real4 after) {
    PRECISE real4 result = (after - before) * real(0.1666666716337204);
    return result;
}

// ... and at an end, from it to the next point and the one after that.
FUNCTION real4 end_step(real4 end, real4 next, real4 after_next) {
    PRECISE real4 near_part = (next - end) * real(0.6666666865348816);
    PRECISE real4 far_part = (after_next - end) * real(0.1666666716337204);
    PRECISE real4 result = near_part - far_part;
    return result;
}
