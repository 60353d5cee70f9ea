// Code header: the ray frame of intersectors.md section 0.1. The ray becomes the z axis, and the
// primitive is moved next to it with the rounding errors of the move put back, so that results are as
// exact at a distance of a million lengths as at one.

struct RayFrame {
    real3 axis_x;  // axis_x, axis_y, axis_z: orthonormal, axis_z along the ray
    real3 axis_y;
    real3 axis_z;
    real3 reference;  // a point of the primitive
    real3 foot;       // the ray's point nearest to the primitive, relative to reference
    real t_foot;      // its ray parameter
    real inv_length;  // 1 / |direction|
};

// Rounding error of a - b, given difference = fl(a - b) (two-sum, Knuth).
FUNCTION real3 difference_error(real3 a, real3 b, real3 difference) {
    PRECISE real3 bb = difference - a;
    PRECISE real3 rest = difference - bb;
    PRECISE real3 error_a = a - rest;
    PRECISE real3 error_b = b + bb;
    PRECISE real3 result = error_a - error_b;
    return result;
}

// Rounding error of s * v, given product = fl(s * v): Dekker's splitting, since fma is not fused everywhere.
FUNCTION real3 product_error(real s, real3 v, real3 product) {
    if (hardware_fma) {
        PRECISE real3 fused = fma(real3(s), v, -product);
        return fused;
    }
    PRECISE real scaled_s = s * real_splitter;
    PRECISE real rest_s = scaled_s - s;
    PRECISE real high_s = scaled_s - rest_s;
    PRECISE real low_s = s - high_s;
    PRECISE real3 scaled_v = v * real_splitter;
    PRECISE real3 rest_v = scaled_v - v;
    PRECISE real3 high_v = scaled_v - rest_v;
    PRECISE real3 low_v = v - high_v;
    PRECISE real3 first = high_v * high_s;
    PRECISE real3 error_1 = first - product;
    PRECISE real3 second = high_v * low_s;
    PRECISE real3 error_2 = error_1 + second;
    PRECISE real3 third = low_v * high_s;
    PRECISE real3 error_3 = error_2 + third;
    PRECISE real3 fourth = low_v * low_s;
    PRECISE real3 result = error_3 + fourth;
    return result;
}

// Frame of the ray origin + t direction at its point t_foot, for a primitive with a point `reference` near
// it.
FUNCTION RayFrame ray_frame_at(real3 origin, real3 direction, real3 reference, real t_foot) {
    RayFrame frame;
    PRECISE real3 s = origin - reference;
    PRECISE real3 s_error = difference_error(origin, reference, s);
    // The raw direction, not the normalised one: normalising rounds it by 6e-8.
    PRECISE real3 step = direction * t_foot;
    PRECISE real3 step_error = product_error(t_foot, direction, step);
    PRECISE real3 near = s + step;
    PRECISE real3 nearer = near + step_error;
    PRECISE real3 foot = nearer + s_error;
    frame.reference = reference;
    frame.foot = foot;
    frame.t_foot = t_foot;
    frame.inv_length = real(1) / sqrt(dot(direction, direction));
    // Orthonormal basis without branches on more than a sign (Duff et al. 2017).
    real3 n = direction * frame.inv_length;
    real side = n.z >= real(0) ? real(1) : real(-1);
    real a = real(-1) / (side + n.z);
    real b = n.x * n.y * a;
    frame.axis_x = real3(real(1) + side * n.x * n.x * a, side * b, -side * n.x);
    frame.axis_y = real3(b, side + n.y * n.y * a, -n.y);
    frame.axis_z = n;
    return frame;
}

// The same where the ray is nearest to the primitive's mean point `reference + middle`.
FUNCTION RayFrame make_ray_frame(real3 origin, real3 direction, real3 reference, real3 middle) {
    return ray_frame_at(origin, direction, reference,
                        dot(middle - (origin - reference), direction) / dot(direction, direction));
}

// A point of the primitive in the frame.
FUNCTION real3 to_frame(RayFrame frame, real3 point) {
    real3 p = (point - frame.reference) - frame.foot;
    return real3(dot(p, frame.axis_x), dot(p, frame.axis_y), dot(p, frame.axis_z));
}

// A vector in the frame.
FUNCTION real3 turn_to_frame(RayFrame frame, real3 v) {
    return real3(dot(v, frame.axis_x), dot(v, frame.axis_y), dot(v, frame.axis_z));
}

// A vector of the frame in the space of the ray.
FUNCTION real3 from_frame(RayFrame frame, real3 v) {
    return frame.axis_x * v.x + frame.axis_y * v.y + frame.axis_z * v.z;
}

// A hit's normal in the frame; it faces the ray where a vanishing radius or an overflow leaves none.
FUNCTION real3 normal_or_facing(real3 normal) {
    bool is_normal = abs(dot(normal, normal) - real(1)) < real(0.5);
    return is_normal ? normalize(normal) : real3(real(0), real(0), real(-1));
}

// Ray parameter of a depth in the frame.
FUNCTION real ray_parameter(RayFrame frame, real z) { return z * frame.inv_length + frame.t_foot; }

// A power of two that brings lengths of `size` near 1 where products of four of them would underflow (scenes
// in nanometres); 1 elsewhere. Multiplying by it rounds nothing.
FUNCTION real safe_unit(real size) { return size < real(1e-5) ? real(8589934592.0) : real(1); }
